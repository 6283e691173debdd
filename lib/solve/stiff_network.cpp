#include "solve/stiff_network.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <new>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "solve/block_cholesky.h"
#include "solve/pair_product.h"

namespace pigment::solve {

namespace {

constexpr int at(int row, int column) { return row * (row + 1) / 2 + column; }  // of a diagonal block

// A factor made anew keeps the pairs of the one before, and with them its order and its pattern, while no more than so many others have
// become stiff. Each costs an iteration or so.
constexpr int most_missing = 10;

// Where no pair is stiffer than so many times its lesser drag the factor is computed in single precision: from 1e6 on it rounds off drags, but
// in jams and uncharged layers solves took no more iterations up to 1e9.
constexpr double single_range = 1e8;

using Edges = std::vector<std::pair<std::int32_t, std::int32_t>>;

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
  std::int32_t i, j;
  double n[3], squeeze;
};

template <typename Pair>
bool is_stiff(const PairSystem& system, const Pair& p, double squeeze, double stiff_over_drag) {
  return squeeze > stiff_over_drag * std::min(system.particle[p.i].across, system.particle[p.j].across);
}

}  // namespace

struct StiffNetwork::Data {
  BlockCholesky factor;
  double stiff_over_drag;
  std::vector<double> x;  // right-hand sides and solutions, by place in the factor
  // A_uw and A_ww^-1 of every particle, row by row; empty without rotation.
  std::vector<double> cross, spin;
  std::vector<char> held;
  std::vector<KnownPairs> known;  // of each chunk
  std::vector<StiffPair> pairs;

  // The stiff pairs.
  Edges choose_pairs(const PairSystem& system);
  // Takes over the system's pairs; of stiff ones that are gone nothing stays.
  void know_pairs(const PairSystem& system);
  // S, factorised, from diagonal_blocks. False where it is not positive definite.
  bool factorize(const PairSystem& system, const Scratch& block);
};

Edges StiffNetwork::Data::choose_pairs(const PairSystem& system) {
  const int chunks = system.topology->chunks().count();
  known.assign(chunks, {});
  std::vector<std::int32_t> first(chunks + 1);  // of each chunk's stiff pairs
  // Here, since nothing may be thrown out of a parallel region.
  for (int c = 0; c < chunks; ++c) {
    known[c].full.reserve(system.full[c].size());
    known[c].squeeze.reserve(system.squeeze[c].size());
  }
#pragma omp parallel for schedule(static)
  for (int c = 0; c < chunks; ++c) {
    const auto take = [&](const auto& some, std::vector<KnownPair>& here) {
      for (const auto& p : some) here.push_back({p.i, p.j, is_stiff(system, p, p.squeeze, stiff_over_drag) ? first[c + 1]++ : -1, 0});
    };
    take(system.full[c], known[c].full);
    take(system.squeeze[c], known[c].squeeze);
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  pairs.assign(first.back(), {});
  Edges edges(pairs.size());
#pragma omp parallel for schedule(static)
  for (int c = 0; c < chunks; ++c)
    for (std::vector<KnownPair>* here : {&known[c].full, &known[c].squeeze})
      for (KnownPair& p : *here) {
        if (p.stiff < 0) continue;
        p.stiff += first[c];
        pairs[p.stiff] = {p.i, p.j, {}, 0};
        edges[p.stiff] = {p.i, p.j};
      }
  return edges;
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

bool StiffNetwork::Data::factorize(const PairSystem& system, const Scratch& block) {
  using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const std::size_t n = system.topology->particles();
  const int D = system.unknowns_per_particle(), entries = D * (D + 1) / 2;
  held = system.held;
  const auto is_held = [&](std::size_t k) { return !held.empty() && held[k]; };
  cross.resize(system.rotation ? n * 9 : 0);
  spin.resize(cross.size());
  x.resize(most_sides * 3 * n);
  Scratch diagonal(9 * n), between(9 * pairs.size());
  double stiffest = 0;  // over its drag
#pragma omp parallel reduction(max : stiffest)
  {
#pragma omp for schedule(static) nowait
    for (std::size_t k = 0; k < n; ++k) {
      const double* own = block.data() + k * entries;
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
      Eigen::Map<Matrix>(diagonal.data() + 9 * static_cast<std::size_t>(factor.place()[k])) = uu;
    }
#pragma omp for schedule(static)
    for (std::size_t q = 0; q < pairs.size(); ++q) {
      const StiffPair& p = pairs[q];
      stiffest = std::max(stiffest, p.squeeze / std::min(system.particle[p.i].across, system.particle[p.j].across));
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
          const bool given = (r == 2 && is_held(p.j)) || (c == 2 && is_held(p.i));
          between[9 * q + 3 * r + c] = given ? 0 : -p.squeeze * p.n[r] * p.n[c];
        }
    }
  }
  const std::span<const double> blocks(diagonal.data(), 9 * n), off(between.data(), 9 * pairs.size());
  return (stiffest < single_range && factor.factorize(blocks, off, Precision::Single)) || factor.factorize(blocks, off);
}

StiffNetwork::StiffNetwork() = default;
StiffNetwork::~StiffNetwork() = default;
StiffNetwork::StiffNetwork(StiffNetwork&&) noexcept = default;
StiffNetwork& StiffNetwork::operator=(StiffNetwork&&) noexcept = default;
bool StiffNetwork::ready() const { return data_ != nullptr; }
double StiffNetwork::work() const { return data_->factor.work(); }
void StiffNetwork::forget() { data_.reset(); }

int StiffNetwork::changed(const PairSystem& system, double times) const {
  int count = count_pairs(system, data_->known, [&](const auto& p, const KnownPair* known) {
    const double now = p.squeeze, then = known ? known->squeeze : 0;
    return is_stiff(system, p, std::max(now, then), data_->stiff_over_drag) && (now > times * then || then > times * now);
  });
  for (std::size_t k = 0; k < system.held.size(); ++k) count += system.held[k] != data_->held[k];
  return count;
}

std::string StiffNetwork::factorize(const PairSystem& system, double stiff_over_drag) {
  const auto missing = [&](const auto& p, const KnownPair* known) {
    return (!known || known->stiff < 0) && is_stiff(system, p, p.squeeze, stiff_over_drag);
  };
  const bool anew = !ready() || count_pairs(system, data_->known, missing) > most_missing;
  const char* const no_memory = "out of memory";
  std::string refusal;
  try {
    if (anew) data_ = std::make_unique<Data>();
    data_->stiff_over_drag = stiff_over_drag;
    const Edges edges = anew ? data_->choose_pairs(system) : Edges();
    // An order is found by one thread; another sums up the blocks meanwhile. Nothing may be thrown out of a parallel region.
    std::optional<Scratch> block;
    bool ordered = !anew;
    if (!anew) {
      block.emplace(diagonal_blocks(system));
    } else {
#pragma omp parallel sections
      {
#pragma omp section
        try {
          ordered = data_->factor.analyze(static_cast<int>(system.topology->particles()), edges);
        } catch (const std::bad_alloc&) {
        }
#pragma omp section
        try {
          block.emplace(diagonal_blocks(system));
        } catch (const std::bad_alloc&) {
        }
      }
    }
    if (!ordered || !block)
      refusal = no_memory;
    else if (data_->know_pairs(system); !data_->factorize(system, *block))
      refusal = "the matrix is not positive definite";
  } catch (const std::bad_alloc&) {
    refusal = no_memory;
  }
  if (!refusal.empty()) data_.reset();
  return refusal;
}

// b = r_u - A_uw A_ww^-1 r_w
void StiffNetwork::eliminate(int begin, int end, const double* r, int side) {
  double* x = data_->x.data() + side * (data_->x.size() / most_sides);
  using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  using Vector = Eigen::Map<const Eigen::Vector3d>;
  const bool rotation = !data_->cross.empty();
  for (int k = begin; k < end; ++k) {
    const double* own = r + static_cast<std::size_t>(k) * (rotation ? stride<6> : stride<3>);
    Eigen::Vector3d v = Vector(own);
    if (rotation) v -= Eigen::Map<const Matrix>(&data_->cross[9 * k]) * (Eigen::Map<const Matrix>(&data_->spin[9 * k]) * Vector(own + place<6>(3)));
    Eigen::Map<Eigen::Vector3d>(x + 3 * static_cast<std::size_t>(data_->factor.place()[k])) = v;
  }
}

void StiffNetwork::solve(int sides) { data_->factor.solve(data_->x.data(), sides); }

double StiffNetwork::substitute(int begin, int end, const std::vector<char>& held, const double* r, double* z, int side) const {
  const double* x = data_->x.data() + side * (data_->x.size() / most_sides);
  using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  using Vector = Eigen::Map<const Eigen::Vector3d>;
  const bool rotation = !data_->cross.empty();
  double product = 0;
  for (int k = begin; k < end; ++k) {
    const std::size_t own = static_cast<std::size_t>(k) * (rotation ? stride<6> : stride<3>);
    const Eigen::Vector3d v = Vector(x + 3 * static_cast<std::size_t>(data_->factor.place()[k]));
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
