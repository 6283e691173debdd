#include "solve/stiff_network.h"

#include <cholmod.h>
#include <omp.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <tuple>
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

// A pair as the factor has it; which of its stiff pairs, -1: none.
struct KnownPair {
  std::int32_t i, j, stiff;
  double squeeze;
};
// Those of one chunk, as the system has them.
struct KnownPairs {
  std::vector<KnownPair> full, squeeze;
};

// Calls each(pair, what is known of it or nullptr). Pairs come and go between the solves of a step, since a law adds to some only while it
// stiffens them; both lists rise by i, then j.
template <typename Pairs, typename Each>
void compare(const Pairs& pairs, std::vector<KnownPair>& known, Each each) {
  auto then = known.begin();
  for (const auto& p : pairs) {
    while (then != known.end() && std::tie(then->i, then->j) < std::tie(p.i, p.j)) ++then;
    const bool there = then != known.end() && then->i == p.i && then->j == p.j;
    each(p, there ? &*then : nullptr);
  }
}

// How many pairs are such, of all chunks.
template <typename Is>
int count_pairs(const PairSystem& system, std::vector<KnownPairs>& known, Is is) {
  const int chunks = system.topology->chunks().count();
  int count = 0;
#pragma omp parallel for schedule(static) reduction(+ : count)
  for (int c = 0; c < chunks; ++c) {
    const auto add = [&](const auto& p, const KnownPair* then) { count += is(p, then); };
    compare(system.full[c], known[c].full, add);
    compare(system.squeeze[c], known[c].squeeze, add);
  }
  return count;
}

struct StiffPair {
  std::int32_t low, high;  // places of its particles in the order of elimination
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
  std::vector<KnownPairs> known;  // of each chunk
  std::vector<StiffPair> pairs;   // sorted by their places
  // Where each particle stands in the order of elimination, which stands where, and the first of `pairs` whose lower place it is.
  std::vector<std::int32_t> place, particle, pairs_begin;

  Data() {
    if (openblas_set_num_threads) openblas_set_num_threads(1);
    cholmod_start(&common);
    common.print = 0;
    common.nmethods = 1;
  }
  ~Data() {
    for (cholmod_dense** dense : {&right, &solution, &work[0], &work[1]})
      if (*dense) cholmod_free_dense(dense, &common);
    if (factor) cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }

  // S, its lower triangle: the diagonal block of each particle, then one block for each stiff pair, rows rising.
  cholmod_sparse* assemble(const PairSystem& system);
  // The stiff pairs, and an order to eliminate their particles in: approximate minimum degree. False where memory is short.
  bool choose_pairs(const PairSystem& system);
  // Takes over the system's pairs; of stiff ones that are gone nothing stays.
  void know_pairs(const PairSystem& system);
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
#pragma omp parallel for schedule(static)
  for (std::size_t at_place = 0; at_place < n; ++at_place) {
    const std::size_t k = particle[at_place];
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
    int entry = static_cast<int>(6 * at_place) + 9 * pairs_begin[at_place];
    for (int c = 0; c < 3; ++c) {
      start[3 * at_place + c] = entry;
      for (int r = c; r < 3; ++r, ++entry) {
        row[entry] = static_cast<int>(3 * at_place) + r;
        value[entry] = uu(r, c);
      }
      for (std::int32_t q = pairs_begin[at_place]; q < pairs_begin[at_place + 1]; ++q) {
        const StiffPair& p = pairs[q];
        for (int r = 0; r < 3; ++r, ++entry) {
          row[entry] = 3 * p.high + r;
          const bool given = (c == 2 && is_held(k)) || (r == 2 && is_held(particle[p.high]));
          value[entry] = given ? 0 : -p.squeeze * p.n[r] * p.n[c];
        }
      }
    }
  }
  start[3 * n] = static_cast<int>(6 * n + 9 * pairs.size());
  return a;
}

bool StiffNetwork::Data::choose_pairs(const PairSystem& system) {
  struct Found {
    std::int32_t i, j;
    KnownPair* pair;
  };
  const std::size_t n = system.topology->particles();
  known.assign(system.full.size(), {});
  std::vector<Found> found;
  for (std::size_t c = 0; c < known.size(); ++c) {
    const auto take = [&](const auto& some, std::vector<KnownPair>& here) {
      here.reserve(some.size());
      for (const auto& p : some) {
        here.push_back({p.i, p.j, -1, 0});
        if (is_stiff(system, p, p.squeeze)) found.push_back({std::min(p.i, p.j), std::max(p.i, p.j), &here.back()});
      }
    };
    take(system.full[c], known[c].full);
    take(system.squeeze[c], known[c].squeeze);
  }
  const auto by_particles = [](const Found& a, const Found& b) { return std::tie(a.i, a.j) < std::tie(b.i, b.j); };
  std::sort(found.begin(), found.end(), by_particles);

  cholmod_sparse* graph = cholmod_allocate_sparse(n, n, found.size(), 1, 1, -1, CHOLMOD_PATTERN, &common);
  if (!graph) return false;
  auto* start = static_cast<int*>(graph->p);
  std::fill(start, start + n + 1, 0);
  for (std::size_t q = 0; q < found.size(); ++q) {
    ++start[found[q].i + 1];
    static_cast<int*>(graph->i)[q] = found[q].j;
  }
  std::partial_sum(start, start + n + 1, start);
  common.method[0].ordering = CHOLMOD_AMD;
  common.postorder = 1;
  cholmod_factor* symbolic = cholmod_analyze(graph, &common);
  cholmod_free_sparse(&graph, &common);
  if (!symbolic) return false;
  particle.assign(static_cast<const int*>(symbolic->Perm), static_cast<const int*>(symbolic->Perm) + n);
  cholmod_free_factor(&symbolic, &common);
  // The matrix is written in this order, so that CHOLMOD need not permute it for every factor.
  common.method[0].ordering = CHOLMOD_NATURAL;
  common.postorder = 0;
  place.resize(n);
  for (std::size_t at_place = 0; at_place < n; ++at_place) place[particle[at_place]] = static_cast<std::int32_t>(at_place);

  for (Found& f : found) std::tie(f.i, f.j) = std::minmax({place[f.i], place[f.j]});
  std::sort(found.begin(), found.end(), by_particles);
  pairs_begin.assign(n + 1, 0);
  for (const Found& f : found) {
    f.pair->stiff = static_cast<std::int32_t>(pairs.size());
    pairs.push_back({f.i, f.j, {}, 0});
    ++pairs_begin[f.i + 1];
  }
  std::partial_sum(pairs_begin.begin(), pairs_begin.end(), pairs_begin.begin());
  return true;
}

void StiffNetwork::Data::know_pairs(const PairSystem& system) {
  for (StiffPair& p : pairs) p.squeeze = 0;
  const int chunks = system.topology->chunks().count();
#pragma omp parallel for schedule(static)
  for (int c = 0; c < chunks; ++c) {
    const auto take = [&](const auto& some, std::vector<KnownPair>& here) {
      std::vector<KnownPair> now;
      now.reserve(some.size());
      compare(some, here, [&](const auto& p, const KnownPair* then) {
        now.push_back({p.i, p.j, then ? then->stiff : -1, p.squeeze});
        if (now.back().stiff < 0) return;
        StiffPair& mine = pairs[now.back().stiff];
        std::copy(p.n, p.n + 3, mine.n);
        mine.squeeze = p.squeeze;
      });
      here = std::move(now);
    };
    take(system.full[c], known[c].full);
    take(system.squeeze[c], known[c].squeeze);
  }
}

StiffNetwork::StiffNetwork() = default;
StiffNetwork::~StiffNetwork() = default;
StiffNetwork::StiffNetwork(StiffNetwork&&) noexcept = default;
StiffNetwork& StiffNetwork::operator=(StiffNetwork&&) noexcept = default;
bool StiffNetwork::ready() const { return data_ && data_->factor; }
void StiffNetwork::forget() { data_.reset(); }

int StiffNetwork::changed(const PairSystem& system, double times) const {
  int count = count_pairs(system, data_->known, [&](const auto& p, const KnownPair* known) {
    const double now = p.squeeze, then = known ? known->squeeze : 0;
    return is_stiff(system, p, std::max(now, then)) && (now > times * then || then > times * now);
  });
  for (std::size_t k = 0; k < system.held.size(); ++k) count += system.held[k] != data_->held[k];
  return count;
}

std::string StiffNetwork::factorize(const PairSystem& system) {
  const std::size_t n = system.topology->particles();
  const auto missing = [&](const auto& p, const KnownPair* known) { return (!known || known->stiff < 0) && is_stiff(system, p, p.squeeze); };
  const bool anew = !ready() || count_pairs(system, data_->known, missing) > most_missing;
  if (anew) data_ = std::make_unique<Data>();
  Data& d = *data_;
  const bool chosen = !anew || d.choose_pairs(system);
  if (chosen) d.know_pairs(system);
  if (cholmod_sparse* a = chosen ? d.assemble(system) : nullptr) {
    if (anew) {
      d.right = cholmod_allocate_dense(3 * n, 1, 3 * n, CHOLMOD_REAL, &d.common);
      d.factor = cholmod_analyze(a, &d.common);
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
    for (int d = 0; d < 3; ++d) b[3 * data_->place[k] + d] = v[d];
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
    const Eigen::Vector3d v = Vector(u + 3 * static_cast<std::size_t>(data_->place[k]));
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
