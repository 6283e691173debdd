// What the five scalars of a pair cost, by how they are found: the fitted functions that a run uses, the leading terms of the
// source's forms, and a table. A hundred thousand pairs of random radii (1:1 to 1:100) and gaps (1e-6 to 0.4 of the smaller
// radius), one after the other as in a step.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "resistance/pair_lubrication.h"
#include "resistance/source_forms.h"

namespace {
using namespace pigment::resistance;

struct Pair {
  double a, b, gap;
};
const std::vector<Pair>& pairs() {
  static const std::vector<Pair> many = [] {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<Pair> made(100000);
    for (Pair& p : made) {
      const double b = 0.125 + uniform(random), ratio = std::pow(100, uniform(random));
      p = {b * ratio, b, b * 1e-6 * std::pow(4e5, uniform(random))};
    }
    return made;
  }();
  return many;
}

// The scalars over R, R^2 or R^3 and times x, which leaves them nearly linear: bilinear between 64 values of kap^2 and 24 a decade
// of x. What a table needs besides its memory: the logarithm of x, and five interpolations from two rows far apart.
class Table {
 public:
  Table() : values_(static_cast<std::size_t>(columns * rows)) {
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const double kap = std::sqrt(static_cast<double>(r) / (rows - 1)) * 0.999999, x = std::exp(low + c * step);
        const double a = 2 / (1 - kap), b = 2 / (1 + kap);  // R = 1
        const PairScalars k = pair_scalars(a, b, x);
        values_[static_cast<std::size_t>(r * columns + c)] = {k.squeeze * x, k.twist, k.shear, k.pump, kap > 0 ? k.shear_pump / kap : 0};
      }
  }
  PairScalars at(double a, double b, double gap) const {
    const double R = a * b / (a + b), kap = (a - b) / (a + b), x = gap / R;
    const double u = std::clamp((std::log(x) - low) / step, 0.0, columns - 1.001), v = kap * kap * (rows - 1.001);
    const int c = static_cast<int>(u), r = static_cast<int>(v);
    const double s = u - c, t = v - r;
    const auto* p = &values_[static_cast<std::size_t>(r * columns + c)];
    std::array<double, 5> k;
    for (std::size_t i = 0; i < 5; ++i)
      k[i] = (1 - t) * ((1 - s) * p[0][i] + s * p[1][i]) + t * ((1 - s) * p[columns][i] + s * p[columns + 1][i]);
    return {k[0] / x * R, k[1] * R * R * R, k[2] * R, k[3] * R * R * R, k[4] * kap * R * R};
  }

 private:
  static constexpr int rows = 64, columns = 24 * 8;
  static constexpr double low = -16.118, step = 0.0959410;  // ln 1e-7; a decade over 24
  std::vector<std::array<double, 5>> values_;
};

template <typename Evaluate>
void measure(benchmark::State& state, Evaluate&& evaluate) {
  const auto& many = pairs();
  std::vector<PairScalars> out(many.size());
  for (auto _ : state) {
    for (std::size_t k = 0; k < many.size(); ++k) out[k] = evaluate(many[k]);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(many.size()));
}

void fitted(benchmark::State& state) {
  measure(state, [](const Pair& p) { return tapered_pair_scalars(p.a, p.b, p.gap, {}); });
}
BENCHMARK(fitted)->Unit(benchmark::kMillisecond);

void leading_terms(benchmark::State& state) {
  measure(state, [](const Pair& p) { return source_pair_scalars(p.a, p.b, p.gap, {}); });
}
BENCHMARK(leading_terms)->Unit(benchmark::kMillisecond);

// largest_error: of squeeze and shear against the functions that the table was filled from, over the scalar with its leading
// factor added (6 pi R, 2 pi R), the order of isolated drag: the shear scalar alone passes through zero at wide gaps.
void table(benchmark::State& state) {
  const Table made;
  measure(state, [&](const Pair& p) { return made.at(p.a, p.b, p.gap); });
  double worst = 0;
  for (const Pair& p : pairs()) {
    const PairScalars exact = pair_scalars(p.a, p.b, p.gap), mine = made.at(p.a, p.b, p.gap);
    const double R = p.a * p.b / (p.a + p.b), two_pi = 2 * 3.14159265358979;
    worst = std::max({worst, std::abs(mine.squeeze - exact.squeeze) / (exact.squeeze + 3 * two_pi * R),
                      std::abs(mine.shear - exact.shear) / (std::abs(exact.shear) + two_pi * R)});
  }
  state.counters["largest_error"] = worst;
}
BENCHMARK(table)->Unit(benchmark::kMillisecond);

}  // namespace
