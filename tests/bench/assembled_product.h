#pragma once
// For comparison: the same matrix with every pair's 6 x 6 block written out (288 bytes), over the same strided vectors, chunks and
// halo as the five-scalar product.
#include <vector>

#include "solve/pair_kernel.h"
#include "solve/pair_product.h"

namespace pigment::bench {

class AssembledSystem {
 public:
  explicit AssembledSystem(const solve::PairSystem& s) : topology_(*s.topology), chunks_(s.full.size()) {
    const Scratch triangles = solve::diagonal_blocks(s);
    diagonal_.resize(topology_.particles());
    for (std::size_t k = 0; k < diagonal_.size(); ++k)
      for (int r = 0; r < 6; ++r)
        for (int c = 0; c <= r; ++c) diagonal_[k].m[c][r] = diagonal_[k].m[r][c] = triangles[k * 21 + r * (r + 1) / 2 + c];
    for (std::size_t chunk = 0; chunk < chunks_.size(); ++chunk) {
      const auto add = [&](const auto& p, auto kernel) {
        Pair pair{p.i, p.j, p.target, {}};
        for (int c = 0; c < 6; ++c) {
          double unit[6] = {}, zero[6] = {}, yi[6] = {}, yj[6] = {};
          unit[c] = 1;
          kernel(p, zero, unit, yi, yj);
          for (int r = 0; r < 6; ++r) pair.block.m[c][r] = yi[r];
        }
        chunks_[chunk].push_back(pair);
      };
      for (const auto& p : s.full[chunk]) add(p, solve::add_full_pair<6>);
      for (const auto& p : s.squeeze[chunk]) add(p, solve::add_squeeze_pair<6>);
    }
  }

  void apply(const double* x, double* y) const {
    const int count = topology_.chunks().count();
#pragma omp parallel
    {
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c) apply_chunk(c, x, y);
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c)
        for (int k = topology_.chunks().begin[c]; k < topology_.chunks().begin[c + 1]; ++k)
          for (const std::int32_t* slot = topology_.slots_begin(k); slot != topology_.slots_end(k); ++slot)
            for (int q = 0; q < 8; ++q) y[static_cast<std::size_t>(k) * 8 + q] += y[(topology_.first_slot() + *slot) * 8 + q];
    }
  }

 private:
  struct Block {
    double m[6][6];  // column by column
  };
  struct Pair {
    std::int32_t i, j, target;
    Block block;  // the force on i of j's motion
  };

  // yi += M xj, yj += M^T xi; six rows as a full four and a half one.
  PIGMENT_WIDE static void multiply(const Block& b, const double* xi, const double* xj, double* yi, double* yj) {
    for (int c = 0; c < 6; ++c) {
      const double v = xj[c < 3 ? c : c + 1];
      double dot = 0;
      for (int r = 0; r < 3; ++r) {
        yi[r] += b.m[c][r] * v;
        yi[r + 4] += b.m[c][r + 3] * v;
        dot += b.m[c][r] * xi[r] + b.m[c][r + 3] * xi[r + 4];
      }
      yj[c < 3 ? c : c + 1] += dot;
    }
  }
  PIGMENT_WIDE void apply_chunk(int c, const double* x, double* y) const {
    for (int k = topology_.chunks().begin[c]; k < topology_.chunks().begin[c + 1]; ++k) {
      double* to = y + static_cast<std::size_t>(k) * 8;
      for (int q = 0; q < 8; ++q) to[q] = 0;
      double unused[8] = {};
      multiply(diagonal_[k], unused, x + static_cast<std::size_t>(k) * 8, to, unused);
    }
    for (std::size_t h = (topology_.first_slot() + topology_.halo_begin(c)) * 8; h < (topology_.first_slot() + topology_.halo_begin(c + 1)) * 8; ++h) y[h] = 0;
    for (const Pair& p : chunks_[c])
      multiply(p.block, x + static_cast<std::size_t>(p.i) * 8, x + static_cast<std::size_t>(p.j) * 8, y + static_cast<std::size_t>(p.i) * 8,
               y + static_cast<std::size_t>(p.target) * 8);
  }

  const solve::PairTopology& topology_;
  std::vector<Block> diagonal_;
  std::vector<std::vector<Pair>> chunks_;
};

}  // namespace pigment::bench
