#include "io/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/error.h"
#include "io/h5.h"

namespace pigment::io {
namespace {

constexpr std::size_t block_values = 1 << 20;  // read at a time
constexpr int deepest_group = 64;              // groups can hold each other in a circle

enum class Class { Number, Integer, Text, Other };
Class class_of(h5::Type type) {
  switch (type) {
    case h5::Type::Float64:
    case h5::Type::Float32:
      return Class::Number;
    case h5::Type::Int64:
    case h5::Type::OtherInteger:
      return Class::Integer;
    case h5::Type::Text:
      return Class::Text;
    case h5::Type::Other:
      break;
  }
  return Class::Other;
}
const char* name_of(Class c) {
  switch (c) {
    case Class::Number:
      return "floats";
    case Class::Integer:
      return "integers";
    case Class::Text:
      return "text";
    case Class::Other:
      break;
  }
  return "neither numbers nor text";
}

std::string index_text(std::size_t flat, const h5::Extent& shape) {
  std::vector<std::size_t> index(shape.size());
  for (std::size_t k = shape.size(); k-- > 0; flat /= shape[k]) index[k] = flat % shape[k];
  return index.empty() ? std::string() : fmt::format(" [{}]", fmt::join(index, ", "));
}

// Gathers what differs among the numbers of one dataset or attribute.
class Numbers {
 public:
  Numbers(Tolerance tolerance, bool nan_equal) : tolerance_(tolerance), nan_equal_(nan_equal) {}
  void add(double a, double b) {
    const std::size_t index = count_++;
    if (a == b || (nan_equal_ && std::isnan(a) && std::isnan(b))) return;
    double allowed = tolerance_.absolute + tolerance_.relative * std::max(std::abs(a), std::abs(b));
    double difference = std::abs(a - b);
    if (std::isfinite(a) && std::isfinite(b)) {
      if (difference <= allowed) return;
    } else {
      difference = std::numeric_limits<double>::infinity();  // no tolerance covers what is not finite
      allowed = 0;
    }
    if (differing_++ == 0 || difference > largest_)
      largest_ = difference, at_ = index, a_ = a, b_ = b, allowed_ = allowed;
  }
  // Empty where nothing differs.
  std::string report(const std::string& path, const h5::Extent& shape) const {
    if (differing_ == 0) return {};
    return fmt::format("{}{}: {} against {}, difference {:.6g}, allowed {:.6g}; {} of {} values differ", path,
                       index_text(at_, shape), a_, b_, largest_, allowed_, differing_, count_);
  }

 private:
  Tolerance tolerance_;
  bool nan_equal_;
  std::size_t count_ = 0, differing_ = 0, at_ = 0;
  double largest_ = 0, a_ = 0, b_ = 0, allowed_ = 0;
};

class Comparer {
 public:
  Comparer(const std::filesystem::path& first, const std::filesystem::path& second,
           const CompareOptions& options)
      : a_(first), b_(second), options_(options) {
    for (const auto& [path, tolerance] : options_.by_path)
      if (!a_.has(path) && !b_.has(path))
        throw InputError(fmt::format("a tolerance is given for {}, which neither file has", path));
  }
  Comparison compare() {
    compare_objects("/", 0);
    return std::move(result_);
  }

 private:
  void differ(const std::string& line) {
    if (!line.empty()) result_.differences.push_back(line);
  }
  bool ignored(const std::string& path) const {
    return std::find(options_.ignore.begin(), options_.ignore.end(), path) != options_.ignore.end();
  }
  Tolerance tolerance_of(std::string path) const {
    for (;;) {
      if (const auto found = options_.by_path.find(path); found != options_.by_path.end())
        return found->second;
      if (path == "/" || path.empty()) return options_.tolerance;
      path.erase(std::max<std::size_t>(path.rfind('/'), path.rfind('/') == 0 ? 1 : 0));
    }
  }

  void compare_objects(const std::string& path, int depth) {
    if (ignored(path)) return;
    if (depth > deepest_group) a_.fail(path, "groups hold each other too deep to be compared");
    const bool group_a = a_.is_group(path), group_b = b_.is_group(path);
    const bool dataset_a = !group_a && a_.is_dataset(path), dataset_b = !group_b && b_.is_dataset(path);
    if (group_a != group_b || dataset_a != dataset_b) {
      differ(fmt::format("{}: a {} against a {}", path, group_a ? "group" : "dataset",
                         group_b ? "group" : "dataset"));
      return;
    }
    compare_attributes(path);
    if (group_a)
      compare_groups(path, depth);
    else if (dataset_a)
      compare_datasets(path);
  }

  void compare_groups(const std::string& path, int depth) {
    const auto in_a = a_.children(path), in_b = b_.children(path);
    std::set<std::string> names(in_a.begin(), in_a.end());
    names.insert(in_b.begin(), in_b.end());
    for (const auto& name : names) {
      const std::string child = path == "/" ? "/" + name : path + "/" + name;
      if (ignored(child)) continue;
      const bool there_a = a_.has(child), there_b = b_.has(child);
      if (there_a && there_b)
        compare_objects(child, depth + 1);
      else if (there_a != there_b)
        differ(fmt::format("{}: only in the {} file", child, there_a ? "first" : "second"));
    }
  }

  void compare_attributes(const std::string& object) {
    const auto in_a = a_.attributes(object), in_b = b_.attributes(object);
    std::set<std::string> names(in_a.begin(), in_a.end());
    names.insert(in_b.begin(), in_b.end());
    for (const auto& name : names) {
      const std::string path = object + "@" + name;
      if (ignored(path)) continue;
      const bool there_a = std::binary_search(in_a.begin(), in_a.end(), name);
      if (there_a != std::binary_search(in_b.begin(), in_b.end(), name)) {
        differ(fmt::format("{}: only in the {} file", path, there_a ? "first" : "second"));
        continue;
      }
      const auto text_a = a_.texts_attribute(object, name), text_b = b_.texts_attribute(object, name);
      const auto number_a = a_.number_attribute(object, name), number_b = b_.number_attribute(object, name);
      if (text_a && text_b) {
        if (*text_a != *text_b)
          differ(fmt::format("{}: \"{}\" against \"{}\"", path, fmt::join(*text_a, "\", \""),
                             fmt::join(*text_b, "\", \"")));
      } else if (number_a && number_b) {
        if (number_a->size() != number_b->size()) {
          differ(fmt::format("{}: {} numbers against {}", path, number_a->size(), number_b->size()));
          continue;
        }
        Numbers numbers(tolerance_of(object), options_.nan_equal);
        for (std::size_t i = 0; i < number_a->size(); ++i) numbers.add((*number_a)[i], (*number_b)[i]);
        differ(numbers.report(path, number_a->size() == 1 ? h5::Extent{} : h5::Extent{number_a->size()}));
      } else {
        const Class class_a = class_of(a_.attribute_type(object, name)),
                    class_b = class_of(b_.attribute_type(object, name));
        differ(fmt::format("{}: {} against {}", path, name_of(class_a), name_of(class_b)));
      }
    }
  }

  void compare_datasets(const std::string& path) {
    const Class class_a = class_of(a_.type(path)), class_b = class_of(b_.type(path));
    const h5::Extent shape = a_.shape(path), shape_b = b_.shape(path);
    if (class_a != class_b || class_a == Class::Other) {
      differ(fmt::format("{}: {} against {}", path, name_of(class_a), name_of(class_b)));
    } else if (shape != shape_b) {
      differ(fmt::format("{}: shape {} against {}", path, h5::to_string(shape), h5::to_string(shape_b)));
    } else if (class_a == Class::Text) {
      compare_texts(path, shape);
    } else {
      compare_numbers(path, shape, class_a);
    }
  }

  void compare_texts(const std::string& path, const h5::Extent& shape) {
    const auto in_a = a_.texts(path), in_b = b_.texts(path);
    std::size_t differing = 0, first = 0;
    for (std::size_t i = 0; i < in_a.size(); ++i)
      if (in_a[i] != in_b[i] && differing++ == 0) first = i;
    if (differing == 0) return;
    // Long texts: from the line where they part.
    const std::string &a = in_a[first], &b = in_b[first];
    const auto parting =
        static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
    const std::size_t line = parting == 0 ? 0 : a.rfind('\n', parting - 1) + 1;
    const auto excerpt = [&](const std::string& text) {
      return text.substr(line, std::min<std::size_t>(text.find('\n', line) - line, 120));
    };
    differ(fmt::format("{}{}: \"{}\" against \"{}\"; {} of {} texts differ", path, index_text(first, shape),
                       excerpt(a), excerpt(b), differing, in_a.size()));
  }

  void compare_numbers(const std::string& path, const h5::Extent& shape, Class kind) {
    const Tolerance tolerance = tolerance_of(path);
    Numbers numbers(tolerance, options_.nan_equal);
    if (kind == Class::Integer && tolerance.relative == 0 && tolerance.absolute == 0) {
      // Exact beyond 2^53, where doubles are not.
      const auto in_a = a_.integers(path), in_b = b_.integers(path);
      std::size_t differing = 0, first = 0;
      for (std::size_t i = 0; i < in_a.size(); ++i)
        if (in_a[i] != in_b[i] && differing++ == 0) first = i;
      if (differing > 0)
        differ(fmt::format("{}{}: {} against {}; {} of {} values differ", path, index_text(first, shape),
                           in_a[first], in_b[first], differing, in_a.size()));
      return;
    }
    if (shape.empty() || h5::element_count(shape) <= block_values) {
      const auto in_a = a_.doubles(path), in_b = b_.doubles(path);
      for (std::size_t i = 0; i < in_a.size(); ++i) numbers.add(in_a[i], in_b[i]);
    } else {
      const std::size_t row = h5::element_count(shape) / shape[0],
                        rows = std::max<std::size_t>(1, block_values / row);
      for (std::size_t first = 0; first < shape[0]; first += rows) {
        const std::size_t count = std::min(rows, shape[0] - first);
        const auto in_a = a_.rows(path, first, count), in_b = b_.rows(path, first, count);
        for (std::size_t i = 0; i < in_a.size(); ++i) numbers.add(in_a[i], in_b[i]);
      }
    }
    differ(numbers.report(path, shape));
  }

  h5::InputFile a_, b_;
  const CompareOptions& options_;
  Comparison result_;
};

}  // namespace

Comparison compare_files(const std::filesystem::path& first, const std::filesystem::path& second,
                         const CompareOptions& options) {
  return Comparer(first, second, options).compare();
}

}  // namespace pigment::io
