#include "solve/block_cholesky.h"

#include <omp.h>

#include <algorithm>
#include <numeric>
#include <type_traits>

namespace pigment::solve {

namespace {

constexpr int B = front_block;

// The tree is cut until no subtree has more than this share of all work, and its pieces are gathered to half as much.
constexpr double part_share = 0.3;
// The work of a supernode beside its arithmetic, in the same unit.
constexpr double overhead = 100;

}  // namespace

bool BlockCholesky::analyze(int nodes, const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) {
  *this = {};
  tree_ = make_elimination_tree(nodes, pairs);
  if (tree_.place.size() != static_cast<std::size_t>(nodes)) return false;
  places_.assign(tree_.supernodes.size(), {});
  std::vector<std::int32_t> supernode_of(tree_.place.size());
  std::size_t values = 0;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Supernode& s = tree_.supernodes[k];
    const FrontSize f = size(static_cast<std::int32_t>(k));
    const std::size_t numbers = static_cast<std::size_t>(f.own) * f.rows();
    places_[k].values = values;
    values += numbers;
    largest_values_ = std::max(largest_values_, numbers);
    most_rows_ = std::max(most_rows_, static_cast<std::size_t>(f.rows()));
    largest_update_ = std::max(largest_update_, static_cast<std::size_t>(f.below) * f.below_rows());
    std::fill(supernode_of.begin() + s.first, supernode_of.begin() + s.end, static_cast<std::int32_t>(k));
  }
  kept_size_ = values;
  kept_ = std::make_unique_for_overwrite<float[]>(values);
  top_rows_.resize(most_sides * most_rows_);
  find_children();
  place_blocks(pairs, supernode_of);
  divide();
  return true;
}

void BlockCholesky::find_children() {
  std::vector<std::int32_t> next(places_.size());
  for (const Supernode& s : tree_.supernodes)
    if (s.parent >= 0) ++next[s.parent];
  std::exclusive_scan(next.begin(), next.end(), next.begin(), 0);
  for (std::size_t k = 0; k < places_.size(); ++k) places_[k].children_begin = places_[k].children_end = next[k];
  children_.resize(places_.size());
  row_in_parent_.resize(tree_.row.size());
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Supernode& s = tree_.supernodes[k];
    if (s.parent < 0) continue;
    children_[places_[s.parent].children_end++] = static_cast<std::int32_t>(k);
    const Supernode& p = tree_.supernodes[s.parent];
    const int own_rows = whole_rows(B * (p.end - p.first));
    std::int32_t at = p.rows_begin;
    for (std::int32_t q = s.rows_begin; q < s.rows_end; ++q) {
      const std::int32_t node = tree_.row[q];
      if (node < p.end) {
        row_in_parent_[q] = B * (node - p.first);
      } else {
        while (tree_.row[at] != node) ++at;
        row_in_parent_[q] = own_rows + B * (at - p.rows_begin);
      }
    }
    places_[k].runs_begin = static_cast<std::int32_t>(runs_.size());
    for (std::int32_t q = s.rows_begin; q < s.rows_end; ++q) {
      if (q > s.rows_begin && row_in_parent_[q] == row_in_parent_[q - 1] + B)
        runs_.back().length += B;
      else
        runs_.push_back({B * (q - s.rows_begin), row_in_parent_[q], B});
    }
    places_[k].runs_end = static_cast<std::int32_t>(runs_.size());
  }
}

void BlockCholesky::place_blocks(const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs, const std::vector<std::int32_t>& supernode_of) {
  const auto ends = [&](std::size_t q) { return std::minmax(tree_.place[pairs[q].first], tree_.place[pairs[q].second]); };
  std::vector<std::int32_t> next(places_.size());
  for (std::size_t q = 0; q < pairs.size(); ++q) ++next[supernode_of[ends(q).first]];
  std::exclusive_scan(next.begin(), next.end(), next.begin(), 0);
  for (std::size_t k = 0; k < places_.size(); ++k) places_[k].blocks_begin = places_[k].blocks_end = next[k];
  blocks_.resize(pairs.size());
  for (std::size_t q = 0; q < pairs.size(); ++q) {
    const auto [low, high] = ends(q);
    const std::int32_t k = supernode_of[low];
    const Supernode& s = tree_.supernodes[k];
    const FrontSize f = size(k);
    std::size_t row = static_cast<std::size_t>(B) * (high - s.first);
    if (high >= s.end) {
      const auto begin = tree_.row.begin() + s.rows_begin, end = tree_.row.begin() + s.rows_end;
      row = f.own_rows() + static_cast<std::size_t>(B) * (std::lower_bound(begin, end, high) - begin);
    }
    const std::size_t column = static_cast<std::size_t>(B) * (low - s.first);
    blocks_[places_[k].blocks_end++] = {static_cast<std::int32_t>(q), tree_.place[pairs[q].first] == high, column * f.rows() + row};
  }
}

// The top: from the roots down, whatever has more than its share of the work below it.
void BlockCholesky::divide() {
  const auto count = static_cast<std::int32_t>(places_.size());
  std::vector<double> work(count);  // of the subtree
  std::vector<std::size_t> update(count);  // numbers
  for (std::int32_t k = 0; k < count; ++k) {
    const FrontSize f = size(k);
    const double rows = f.rows(), own = overhead + f.own * rows * rows;
    update[k] = static_cast<std::size_t>(f.below) * f.below_rows();
    work[k] += own;
    work_ += own;
    if (tree_.supernodes[k].parent >= 0) work[tree_.supernodes[k].parent] += work[k];
  }
  const double share = part_share * work_;
  std::vector<std::int32_t> top_unknown(tree_.place.size(), -1);
  Part part{};
  std::size_t used = 0;
  const auto finish = [&](std::int32_t end) {
    part.end = end;
    if (part.work > 0) parts_.push_back(part);
    part = {end, end, 0, 0};
    used = 0;
  };
  for (std::int32_t k = 0; k < count; ++k) {
    const Supernode& s = tree_.supernodes[k];
    Place& place = places_[k];
    if (work[k] > share) {
      place.part = -1;
      place.update = top_memory_;
      top_memory_ += update[k];
      top_.push_back(k);
      for (std::int32_t node = s.first; node < s.end; ++node, top_unknowns_ += B) top_unknown[node] = static_cast<std::int32_t>(top_unknowns_);
      continue;
    }
    // A subtree's updates are a stack: its last ones are the children's of the next.
    place.part = static_cast<std::int32_t>(parts_.size());
    for (std::int32_t c = place.children_begin; c < place.children_end; ++c) used -= update[children_[c]];
    place.update = used;
    used += update[k];
    part.memory = std::max(part.memory, used);
    if (s.parent < 0 || work[s.parent] > share) {
      part.work += work[k];
      if (part.work > 0.5 * share) finish(k + 1);
    }
  }
  finish(count);

  parts_by_work_.resize(parts_.size());
  std::iota(parts_by_work_.begin(), parts_by_work_.end(), 0);
  std::stable_sort(parts_by_work_.begin(), parts_by_work_.end(), [&](std::int32_t a, std::int32_t b) { return parts_[a].work > parts_[b].work; });
  target_.resize(tree_.row.size());
  for (std::int32_t k = 0; k < count; ++k)
    for (std::int32_t q = tree_.supernodes[k].rows_begin; q < tree_.supernodes[k].rows_end; ++q) {
      const std::int32_t node = tree_.row[q];
      target_[q] = places_[k].part >= 0 && top_unknown[node] >= 0 ? -1 - top_unknown[node] : B * node;
    }
  for (const Part& p : parts_) updates_.push_back(std::make_unique_for_overwrite<std::byte[]>(p.memory * sizeof(double)));
  updates_.push_back(std::make_unique_for_overwrite<std::byte[]>(top_memory_ * sizeof(double)));
  to_top_.resize(most_sides * parts_.size() * top_unknowns_);
}

FrontSize BlockCholesky::size(std::int32_t k) const {
  const Supernode& s = tree_.supernodes[k];
  return {B * (s.end - s.first), B * (s.rows_end - s.rows_begin)};
}

template <typename T>
Front<T> BlockCholesky::front(std::int32_t k, T* values, T* update) const {
  if constexpr (std::is_same_v<T, float>) values = kept_.get() + places_[k].values;
  return {size(k), values, update};
}

template <typename T>
T* BlockCholesky::update_of(std::int32_t k) const {
  return reinterpret_cast<T*>(updates_[places_[k].part < 0 ? parts_.size() : places_[k].part].get()) + places_[k].update;
}

// Columns of the front, the own ones and then those below; these only where children add to them.
template <typename T>
void BlockCholesky::clear(std::int32_t k, const Front<T>& f, int begin, int end) const {
  const std::size_t rows = f.rows(), below_rows = f.below_rows();
  for (int j = begin; j < std::min(end, f.own); ++j) std::fill_n(f.values + j * rows, rows, T(0));
  for (int j = std::max(begin, f.own) - f.own; j < end - f.own && has_children(k); ++j)
    std::fill(f.update + j * below_rows + first_row(j), f.update + (j + 1) * below_rows, T(0));
}

template <typename T>
void BlockCholesky::add_numbers(std::int32_t k, const Front<T>& f, std::span<const double> diagonal, std::span<const double> between) const {
  const Supernode& s = tree_.supernodes[k];
  const auto rows = static_cast<std::size_t>(f.rows());
  for (std::int32_t node = s.first; node < s.end; ++node)
    for (int c = 0; c < B; ++c) std::copy_n(&diagonal[9 * static_cast<std::size_t>(node) + B * c], B, f.values + B * (node - s.first) * (rows + 1) + c * rows);
  for (std::int32_t b = places_[k].blocks_begin; b < places_[k].blocks_end; ++b) {
    const double* from = &between[9 * static_cast<std::size_t>(blocks_[b].pair)];
    T* to = f.values + blocks_[b].values;
    for (int c = 0; c < B; ++c)
      for (int r = 0; r < B; ++r) to[c * rows + r] = static_cast<T>(from[blocks_[b].turned ? B * c + r : B * r + c]);
  }
}

template <typename T>
void BlockCholesky::add_update(const Front<T>& f, std::int32_t child, int from) const {
  const std::size_t rows = f.rows(), below_rows = f.below_rows(), child_rows = size(child).below_rows();
  const int own_rows = f.own_rows(), column = row_in_parent_[tree_.supernodes[child].rows_begin + from / B];
  const bool is_own = column < own_rows;
  // So that rows of the front index it, also where the own ones are not there.
  T* to = is_own ? f.values + column * rows : f.update + static_cast<std::ptrdiff_t>(column - own_rows) * static_cast<std::ptrdiff_t>(below_rows) - own_rows;
  const std::span<const Run> runs(runs_.data() + places_[child].runs_begin, runs_.data() + places_[child].runs_end);
  const auto first = std::partition_point(runs.begin(), runs.end(), [&](const Run& run) { return run.from + run.length <= from; });
  add_runs<T>(to, is_own ? rows : below_rows, update_of<T>(child) + from * child_rows, child_rows, from, {first, runs.end()});
}

template <typename T>
void BlockCholesky::gather(std::int32_t k, const Front<T>& f, std::span<const double> diagonal, std::span<const double> between) const {
  clear(k, f, 0, f.own + f.below);
  add_numbers(k, f, diagonal, between);
  for (std::int32_t c = places_[k].children_begin; c < places_[k].children_end; ++c)
    for (int from = 0; from < size(children_[c]).below; from += B) add_update(f, children_[c], from);
}

template <typename T>
bool BlockCholesky::factor_part(std::int32_t part, std::span<const double> diagonal, std::span<const double> between, T* values, T* work) const {
  for (std::int32_t k = parts_[part].begin; k < parts_[part].end; ++k) {
    if (places_[k].part != part) continue;
    // Its update goes where the children's are, once they have been read.
    const Front<T> f = front(k, values, work);
    gather(k, f, diagonal, between);
    if (!factor_front(f, has_children(k))) return false;
    if constexpr (std::is_same_v<T, double>) keep_columns(f, 0, f.own, kept_.get() + places_[k].values);
    T* update = update_of<T>(k);
    for (int j = 0; j < f.below; ++j) {
      const std::size_t column = static_cast<std::size_t>(j) * f.below_rows();
      std::copy(work + column + first_row(j), work + column + f.below_rows(), update + column + first_row(j));
    }
  }
  return true;
}

// By all threads; `good` is shared.
template <typename T>
void BlockCholesky::factor_top(std::span<const double> diagonal, std::span<const double> between, T* values, bool& good) const {
  for (std::size_t t = 0; t < top_.size() && good; ++t) {
    const std::int32_t k = top_[t];
    const Front<T> f = front(k, values, update_of<T>(k));
#pragma omp for schedule(static)
    for (int column = 0; column < f.own + f.below; column += B) clear(k, f, column, column + B);
#pragma omp single
    add_numbers(k, f, diagonal, between);
    for (std::int32_t c = places_[k].children_begin; c < places_[k].children_end; ++c) {
      const int columns = size(children_[c]).below;
#pragma omp for schedule(dynamic, 8)
      for (int from = 0; from < columns; from += B) add_update(f, children_[c], from);
    }
    for (int begin = 0; begin < f.own && good; begin += front_panel) {
      const int end = std::min(begin + front_panel, f.own);
#pragma omp barrier
#pragma omp single
      good = factor_panel(f, begin, end);
      if (!good) break;
#pragma omp for schedule(dynamic, 4) nowait
      for (int column = end; column < f.own; column += B) subtract_from_own(f, begin, end, column);
#pragma omp for schedule(dynamic, 4)
      for (int column = 0; column < f.below; column += B) subtract_from_below(f, begin, end, column, has_children(k));
    }
    if constexpr (std::is_same_v<T, double>) {
#pragma omp for schedule(static)
      for (int column = 0; column < f.own; column += B) keep_columns(f, column, column + B, kept_.get() + places_[k].values);
    }
  }
}

template <typename T>
bool BlockCholesky::factorize(std::span<const double> diagonal, std::span<const double> between) const {
  bool good = true;
  // Here, since nothing may be thrown out of a parallel region.
  const std::size_t values_room = std::is_same_v<T, double> ? largest_values_ : 0, room = values_room + largest_update_;
  const auto all_work = std::make_unique_for_overwrite<T[]>(room * static_cast<std::size_t>(omp_get_max_threads()));
#pragma omp parallel
  {
    T* values = all_work.get() + room * static_cast<std::size_t>(omp_get_thread_num());
#pragma omp for schedule(dynamic, 1)
    for (std::size_t q = 0; q < parts_.size(); ++q)
      if (!factor_part<T>(parts_by_work_[q], diagonal, between, values, values + values_room)) {
#pragma omp atomic write
        good = false;
      }
    factor_top<T>(diagonal, between, all_work.get(), good);
  }
  return good;
}

bool BlockCholesky::factorize(std::span<const double> diagonal, std::span<const double> between, Precision precision) {
  return precision == Precision::Single ? factorize<float>(diagonal, between) : factorize<double>(diagonal, between);
}

}  // namespace pigment::solve
