#include "solve/stiff_network.h"

#include <cholmod.h>
#include <omp.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <utility>

#include "solve/pair_product.h"

// Where the BLAS under CHOLMOD is OpenBLAS: its sums depend on how many threads it takes, and results must not.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace pigment::solve {

namespace {

constexpr int at(int row, int column) { return row * (row + 1) / 2 + column; }  // of a diagonal block

// A pair is stiff where its squeeze is so many times the lesser drag. In an uncharged layer of 4,700 particles a thousandth was
// reached in 9 to 13 iterations with anything from 2 to 100, in a jammed charged one in 12 with 2, 15 with 10, 48 with 100, of ever fewer pairs.
constexpr double stiff_over_drag = 10;
// A factor made anew keeps the pairs of the one before, and with them its order and its pattern, while no more than so many others have
// become stiff. Each costs an iteration or so.
constexpr int most_missing = 10;

template <typename Each>
void each_pair(const PairSystem& system, Each each) {
  for (int c = 0; c < system.topology->chunks().count(); ++c) {
    for (const FullPair& p : system.full[c]) each(p);
    for (const SqueezePair& p : system.squeeze[c]) each(p);
  }
}

struct StiffPair {
  std::int32_t low, high;  // particles
  double n[3], squeeze;
};

template <typename Pair>
bool is_stiff(const PairSystem& system, const Pair& p, double squeeze) {
  return squeeze > stiff_over_drag * std::min(system.particle[p.i].across, system.particle[p.j].across);
}

}  // namespace

struct StiffNetwork::Data {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
  cholmod_dense *right = nullptr, *solution = nullptr, *work[2] = {nullptr, nullptr};
  // A_uw and A_ww^-1 of every particle, row by row; empty without rotation.
  std::vector<double> cross, spin;
  std::vector<char> held;
  std::vector<double> squeeze;  // of every pair, as the factor has it; chunk by chunk, full ones first
  std::vector<StiffPair> pairs;    // sorted by their particles
  std::vector<std::int32_t> slot;  // of every pair: which of `pairs` it is; -1: none

  Data() {
    if (openblas_set_num_threads) openblas_set_num_threads(1);
    cholmod_start(&common);
    common.print = 0;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 1;
  }
  ~Data() {
    for (cholmod_dense** dense : {&right, &solution, &work[0], &work[1]})
      if (*dense) cholmod_free_dense(dense, &common);
    if (factor) cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }

  // S, its lower triangle: the diagonal block of each particle, then one block for each stiff pair, rows rising.
  cholmod_sparse* assemble(const PairSystem& system);
  // An elimination order of particles (approximate minimum degree), each one's three unknowns together.
  std::vector<int> order(std::size_t n);
  void choose_pairs(const PairSystem& system);
  // How many stiff pairs are not among `pairs`.
  int missing(const PairSystem& system) const;
};

cholmod_sparse* StiffNetwork::Data::assemble(const PairSystem& system) {
  using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const std::size_t n = system.topology->particles();
  const int D = system.unknowns_per_particle(), entries = D * (D + 1) / 2;
  const std::vector<double> block = diagonal_blocks(system);
  held = system.held;
  const auto is_held = [&](std::size_t k) { return !held.empty() && held[k]; };
  cross.resize(system.rotation ? n * 9 : 0);
  spin.resize(cross.size());
  cholmod_sparse* a = cholmod_allocate_sparse(3 * n, 3 * n, 6 * n + 9 * pairs.size(), 1, 1, -1, CHOLMOD_REAL, &common);
  if (!a) return nullptr;
  auto* start = static_cast<int*>(a->p);
  auto* row = static_cast<int*>(a->i);
  auto* value = static_cast<double*>(a->x);
  int entry = 0;
  auto pair = pairs.begin();
  for (std::size_t k = 0; k < n; ++k) {
    const double* own = &block[k * entries];
    Matrix uu;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c <= r; ++c) uu(r, c) = uu(c, r) = own[at(r, c)];
    if (system.rotation) {
      Matrix uw, ww;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
          uw(r, c) = own[at(3 + c, r)];
          ww(r, c) = own[at(3 + std::max(r, c), 3 + std::min(r, c))];
        }
      if (is_held(k)) uw.row(2).setZero();
      const Matrix inverse = ww.llt().solve(Matrix::Identity());
      uu -= uw * inverse * uw.transpose();
      Eigen::Map<Matrix>(cross.data() + 9 * k) = uw;
      Eigen::Map<Matrix>(spin.data() + 9 * k) = inverse;
    }
    if (is_held(k)) {
      uu.row(2).setZero();
      uu.col(2).setZero();
      uu(2, 2) = 1;
    }
    const auto end = std::find_if(pair, pairs.end(), [k](const StiffPair& p) { return p.low != static_cast<std::int32_t>(k); });
    for (int c = 0; c < 3; ++c) {
      start[3 * k + c] = entry;
      for (int r = c; r < 3; ++r, ++entry) {
        row[entry] = static_cast<int>(3 * k) + r;
        value[entry] = uu(r, c);
      }
      for (auto p = pair; p != end; ++p)
        for (int r = 0; r < 3; ++r, ++entry) {
          row[entry] = 3 * p->high + r;
          const bool given = (c == 2 && is_held(k)) || (r == 2 && is_held(p->high));
          value[entry] = given ? 0 : -p->squeeze * p->n[r] * p->n[c];
        }
    }
    pair = end;
  }
  start[3 * n] = entry;
  return a;
}

std::vector<int> StiffNetwork::Data::order(std::size_t n) {
  std::vector<int> unknown(3 * n);
  cholmod_sparse* graph = cholmod_allocate_sparse(n, n, pairs.size(), 1, 1, -1, CHOLMOD_PATTERN, &common);
  if (!graph) return {};
  auto* start = static_cast<int*>(graph->p);
  std::fill(start, start + n + 1, 0);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    ++start[pairs[p].low + 1];
    static_cast<int*>(graph->i)[p] = pairs[p].high;
  }
  for (std::size_t k = 0; k < n; ++k) start[k + 1] += start[k];
  std::vector<int> particle(n);
  const bool ordered = cholmod_amd(graph, nullptr, 0, particle.data(), &common);
  cholmod_free_sparse(&graph, &common);
  if (!ordered) return {};
  for (std::size_t k = 0; k < n; ++k)
    for (int d = 0; d < 3; ++d) unknown[3 * k + d] = 3 * particle[k] + d;
  return unknown;
}

void StiffNetwork::Data::choose_pairs(const PairSystem& system) {
  pairs.clear();
  slot.clear();
  std::vector<std::pair<std::pair<std::int32_t, std::int32_t>, std::size_t>> found;
  each_pair(system, [&](const auto& p) {
    if (is_stiff(system, p, p.squeeze)) found.push_back({{std::min(p.i, p.j), std::max(p.i, p.j)}, slot.size()});
    slot.push_back(-1);
  });
  std::sort(found.begin(), found.end());
  for (const auto& [particles, pair] : found) {
    slot[pair] = static_cast<std::int32_t>(pairs.size());
    pairs.push_back({particles.first, particles.second, {}, 0});
  }
}

int StiffNetwork::Data::missing(const PairSystem& system) const {
  int count = 0;
  std::size_t q = 0;
  each_pair(system, [&](const auto& p) { count += slot[q++] < 0 && is_stiff(system, p, p.squeeze); });
  return count;
}

StiffNetwork::StiffNetwork() = default;
StiffNetwork::~StiffNetwork() = default;
StiffNetwork::StiffNetwork(StiffNetwork&&) noexcept = default;
StiffNetwork& StiffNetwork::operator=(StiffNetwork&&) noexcept = default;
bool StiffNetwork::ready() const { return data_ && data_->factor; }
void StiffNetwork::forget() { data_.reset(); }

int StiffNetwork::changed(const PairSystem& system, double times) const {
  int count = 0;
  std::size_t q = 0;
  for (std::size_t k = 0; k < system.held.size(); ++k) count += system.held[k] != data_->held[k];
  each_pair(system, [&](const auto& p) {
    const double now = p.squeeze, then = data_->squeeze[q];
    if (is_stiff(system, p, std::max(now, then)) && (now > times * then || then > times * now)) ++count;
    ++q;
  });
  return count;
}

std::string StiffNetwork::factorize(const PairSystem& system) {
  const std::size_t n = system.topology->particles();
  const bool anew = !ready() || data_->missing(system) > most_missing;
  if (anew) data_ = std::make_unique<Data>();
  Data& d = *data_;
  if (anew) d.choose_pairs(system);
  d.squeeze.clear();
  each_pair(system, [&](const auto& p) {
    if (const std::int32_t at = d.slot[d.squeeze.size()]; at >= 0) {
      std::copy(p.n, p.n + 3, d.pairs[at].n);
      d.pairs[at].squeeze = p.squeeze;
    }
    d.squeeze.push_back(p.squeeze);
  });
  if (cholmod_sparse* a = d.assemble(system)) {
    if (anew) {
      d.right = cholmod_allocate_dense(3 * n, 1, 3 * n, CHOLMOD_REAL, &d.common);
      std::vector<int> order = d.order(n);
      if (!order.empty()) d.factor = cholmod_analyze_p(a, order.data(), nullptr, 0, &d.common);
    }
    // CHOLMOD starts threads of its own for a few hundred numbers at a time, which takes as long as the factor itself.
    const int levels = omp_get_max_active_levels();
    omp_set_max_active_levels(0);
    if (d.factor && d.common.status >= CHOLMOD_OK) cholmod_factorize(a, d.factor, &d.common);
    omp_set_max_active_levels(levels);
    cholmod_free_sparse(&a, &d.common);
  }
  if (d.right && d.factor && d.common.status == CHOLMOD_OK) return "";
  const bool indefinite = d.common.status == CHOLMOD_NOT_POSDEF;
  data_.reset();
  return indefinite ? "the matrix is not positive definite" : "CHOLMOD failed (out of memory?)";
}

// b = r_u - A_uw A_ww^-1 r_w
void StiffNetwork::eliminate(int begin, int end, const double* r) {
  using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  using Vector = Eigen::Map<const Eigen::Vector3d>;
  auto* b = static_cast<double*>(data_->right->x);
  const bool rotation = !data_->cross.empty();
  for (int k = begin; k < end; ++k) {
    const double* own = r + static_cast<std::size_t>(k) * (rotation ? stride<6> : stride<3>);
    Eigen::Vector3d v = Vector(own);
    if (rotation) v -= Eigen::Map<const Matrix>(&data_->cross[9 * k]) * (Eigen::Map<const Matrix>(&data_->spin[9 * k]) * Vector(own + place<6>(3)));
    for (int d = 0; d < 3; ++d) b[3 * k + d] = v[d];
  }
}

void StiffNetwork::solve() {
  cholmod_solve2(CHOLMOD_A, data_->factor, data_->right, nullptr, &data_->solution, nullptr, &data_->work[0], &data_->work[1], &data_->common);
}

double StiffNetwork::substitute(int begin, int end, const std::vector<char>& held, const double* r, double* z) const {
  using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  using Vector = Eigen::Map<const Eigen::Vector3d>;
  const auto* u = static_cast<const double*>(data_->solution->x);
  const bool rotation = !data_->cross.empty();
  double product = 0;
  for (int k = begin; k < end; ++k) {
    const std::size_t own = static_cast<std::size_t>(k) * (rotation ? stride<6> : stride<3>);
    const Eigen::Vector3d v = Vector(u + 3 * static_cast<std::size_t>(k));
    for (int d = 0; d < 3; ++d) z[own + d] = v[d];
    if (!held.empty() && held[k]) z[own + 2] = 0;
    product += Vector(r + own).dot(Vector(z + own));
    if (rotation) {
      const Vector torque(r + own + place<6>(3));
      const Eigen::Vector3d w = Eigen::Map<const Matrix>(&data_->spin[9 * k]) * (torque - Eigen::Map<const Matrix>(&data_->cross[9 * k]).transpose() * v);
      for (int d = 0; d < 3; ++d) z[own + place<6>(3) + d] = w[d];
      product += torque.dot(w);
    }
  }
  return product;
}

}  // namespace pigment::solve
