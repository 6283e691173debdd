#include "solve/cholmod_factor.h"

#include <cholmod.h>

#include <algorithm>
#include <cstring>

#include "solve/pair_kernel.h"

// Where the BLAS under CHOLMOD is OpenBLAS: its sums depend on how many threads it takes, and results must not.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace pigment::solve {

struct CholmodFactor::Data {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
  Data() {
    if (openblas_set_num_threads) openblas_set_num_threads(1);
    cholmod_start(&common);
    common.print = 0;
    common.nmethods = 1;  // approximate minimum degree alone: nested dissection takes longer than it saves at this size
    common.method[0].ordering = CHOLMOD_AMD;
    common.postorder = 1;
  }
  ~Data() {
    if (factor) cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
};

namespace {

constexpr int at(int row, int column) { return row * (row + 1) / 2 + column; }  // of a diagonal block

// Lower triangle, column by column of D x D blocks: the diagonal block of each particle, then one block for each pair (i, j)
// with j below i, rows rising.
template <int D>
cholmod_sparse* assemble(const PairSystem& system, cholmod_common* common) {
  const PairTopology& topology = *system.topology;
  const std::size_t n = topology.particles();
  std::vector<double> diagonal = diagonal_blocks(system);
  const auto is_held = [&](std::size_t k) { return !system.held.empty() && system.held[k]; };
  for (std::size_t k = 0; k < n; ++k)
    if (is_held(k))
      for (int d = 0; d < D; ++d) diagonal[k * (D * (D + 1) / 2) + at(std::max(d, 2), std::min(d, 2))] = d == 2 ? 1 : 0;
  struct Block {
    std::int32_t row;
    double value[D * D];  // column-major
  };
  std::vector<std::vector<Block>> columns(n);
  const double zero[D] = {};
  for (int c = 0; c < topology.chunks().count(); ++c) {
    const auto add = [&](const auto& p, auto kernel) {
      Block block{p.j, {}};
      for (int d = 0; d < D; ++d) {
        double unit[D] = {}, yi[D] = {}, yj[D] = {};
        unit[d] = 1;
        kernel(p, unit, zero, yi, yj);
        for (int r = 0; r < D; ++r) block.value[d * D + r] = yj[r];
      }
      for (int d = 0; d < D; ++d) {
        if (is_held(p.i)) block.value[2 * D + d] = 0;
        if (is_held(p.j)) block.value[d * D + 2] = 0;
      }
      columns[p.i].push_back(block);
    };
    for (const FullPair& p : system.full[c]) add(p, add_full_pair<D>);
    for (const SqueezePair& p : system.squeeze[c]) add(p, add_squeeze_pair<D>);
  }
  std::size_t entries = 0;
  for (auto& column : columns) {
    std::sort(column.begin(), column.end(), [](const Block& a, const Block& b) { return a.row < b.row; });
    entries += column.size() * D * D + D * (D + 1) / 2;
  }
  cholmod_sparse* a = cholmod_allocate_sparse(n * D, n * D, entries, 1, 1, -1, CHOLMOD_REAL, common);
  if (!a) return nullptr;
  auto* start = static_cast<int*>(a->p);
  auto* row = static_cast<int*>(a->i);
  auto* value = static_cast<double*>(a->x);
  std::size_t entry = 0;
  for (std::size_t k = 0; k < n; ++k)
    for (int d = 0; d < D; ++d) {
      start[k * D + d] = static_cast<int>(entry);
      for (int r = d; r < D; ++r, ++entry) {
        row[entry] = static_cast<int>(k * D + r);
        value[entry] = diagonal[k * (D * (D + 1) / 2) + at(r, d)];
      }
      for (const Block& b : columns[k])
        for (int r = 0; r < D; ++r, ++entry) {
          row[entry] = b.row * D + r;
          value[entry] = b.value[d * D + r];
        }
    }
  start[n * D] = static_cast<int>(entry);
  return a;
}

}  // namespace

CholmodFactor::CholmodFactor() = default;
CholmodFactor::~CholmodFactor() = default;
CholmodFactor::CholmodFactor(CholmodFactor&&) noexcept = default;
CholmodFactor& CholmodFactor::operator=(CholmodFactor&&) noexcept = default;
bool CholmodFactor::ready() const { return data_ && data_->factor; }

std::string CholmodFactor::factorize(const PairSystem& system) {
  data_ = std::make_unique<Data>();
  cholmod_common* common = &data_->common;
  cholmod_sparse* a = system.rotation ? assemble<6>(system, common) : assemble<3>(system, common);
  if (!a) return "out of memory";
  data_->factor = cholmod_analyze(a, common);
  const bool analysed = data_->factor && common->status >= CHOLMOD_OK;
  if (analysed) cholmod_factorize(a, data_->factor, common);
  cholmod_free_sparse(&a, common);
  if (analysed && common->status == CHOLMOD_OK) return "";
  const bool indefinite = common->status == CHOLMOD_NOT_POSDEF;
  data_.reset();
  return indefinite ? "the matrix is not positive definite" : "CHOLMOD failed (out of memory?)";
}

void CholmodFactor::solve(const std::vector<double>& b, std::vector<double>& x) {
  cholmod_dense right{};
  right.nrow = right.d = right.nzmax = b.size();
  right.ncol = 1;
  right.x = const_cast<double*>(b.data());  // CHOLMOD reads it only
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, data_->factor, &right, &data_->common);
  x.resize(b.size());
  std::memcpy(x.data(), solution->x, b.size() * sizeof(double));
  cholmod_free_dense(&solution, &data_->common);
}

}  // namespace pigment::solve
