#include <fmt/format.h>

#include <algorithm>

#include "io/export.h"
#include "io/file_header.h"
#include "io/file_units.h"
#include "io/text_file.h"

namespace pigment::io {
namespace {

struct Column {
  std::string heading;
  std::vector<double> values;
};

// One dataset.
struct Table {
  std::string name;
  std::vector<Column> columns;
  std::size_t rows() const { return columns[0].values.size(); }
};

// A number a particle makes a table that no spreadsheet opens, beside what else its group holds.
constexpr std::size_t most_columns = 1000;

std::string heading(const h5::InputFile& file, const std::string& path, const std::string& name) {
  const std::string unit = unit_of(file, path);
  return fmt::format("{} [{}]", name, unit.empty() ? "1" : unit);
}

// One dataset as columns; nothing where it is no table of numbers.
std::vector<Column> columns_of(const h5::InputFile& file, const std::string& path, const std::string& name) {
  std::vector<Column> columns;
  if (!file.is_dataset(path) || !file.is_number(path)) return columns;
  h5::Extent shape = file.shape(path);
  if (shape.size() == 3 && shape[0] == 1) shape.erase(shape.begin());  // the one frame of a packing
  if (shape.empty() || shape.size() > 3 || h5::element_count(shape) == 0) return columns;
  const std::vector<double> values = file.doubles(path);
  const std::size_t rows = shape[0], width = values.size() / rows;
  for (std::size_t k = 0; k < width; ++k) {
    std::string label = name;
    if (shape.size() == 2) label += fmt::format("_{}", k);
    if (shape.size() == 3) label += fmt::format("_{}_{}", k / shape[2], k % shape[2]);
    Column column{heading(file, path, label), std::vector<double>(rows)};
    for (std::size_t i = 0; i < rows; ++i) column.values[i] = values[i * width + k];
    columns.push_back(std::move(column));
  }
  return columns;
}

std::string default_object(const h5::InputFile& file) {
  const std::string kind = read_header(file).kind;
  if (file.is_group("/observables") && !file.children("/observables").empty()) return "/observables";
  if (file.is_group("/particles/layer")) return "/particles/layer";
  if (!kind.empty() && file.is_group("/" + kind)) return "/" + kind;
  file.fail("/", fmt::format("say which group or dataset to write; there is {}",
                             fmt::join(file.children("/"), ", ")));
}

std::string last_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

// A time-dependent element with one number a time.
bool is_curve(const h5::InputFile& file, const std::string& element) {
  return file.is_dataset(element + "/value") && file.shape(element + "/value").size() == 1;
}

std::vector<Table> tables_below(const h5::InputFile& file, const std::string& object) {
  std::vector<Table> tables;
  const auto add = [&](const std::string& path, const std::string& name) {
    std::vector<Column> columns = columns_of(file, path, name);
    if (!columns.empty()) tables.push_back({name, std::move(columns)});
  };
  if (!file.is_group(object)) {
    add(object, last_name(object));
    return tables;
  }
  const auto names = file.children(object);
  // What the rest is a function of comes first.
  for (const char* first : {"time", "step"}) {
    if (file.is_dataset(object + "/" + first)) {
      add(object + "/" + first, first);
    } else {
      for (const auto& name : names)  // that of the first time-dependent element
        if (const std::string element = object + "/" + name;
            is_curve(file, element) && file.is_dataset(element + "/" + first)) {
          add(element + "/" + first, first);
          break;
        }
    }
  }
  for (const auto& name : names) {
    const std::string path = object + "/" + name;
    if (name == "time" || name == "step") continue;
    if (file.is_dataset(path))
      add(path, name);
    else if (is_curve(file, path) ||
             (file.is_dataset(path + "/value") && file.shape(path + "/value").size() == 3))
      add(path + "/value", name);
  }
  return tables;
}

}  // namespace

CsvLeftOut export_csv(const std::filesystem::path& input, const std::string& object,
                       const std::filesystem::path& output) {
  const h5::InputFile file(input);
  const std::string path = object.empty() ? default_object(file) : object;
  if (!file.has(path)) file.fail(path, "is missing");
  auto tables = tables_below(file, path);
  if (tables.empty()) file.fail(path, "holds no table of numbers; name a dataset or another group");
  // The rows that most of the datasets have.
  std::size_t rows = 0, votes = 0;
  for (const auto& table : tables) {
    const auto same =
        static_cast<std::size_t>(std::count_if(tables.begin(), tables.end(), [&](const auto& t) {
          return t.rows() == table.rows();
        }));
    if (same > votes) votes = same, rows = table.rows();
  }
  CsvLeftOut left_out;
  std::string line;
  std::vector<const Column*> columns;
  const auto leave_out = [](std::string& list, const Table& table) {
    list += (list.empty() ? "" : ", ") + table.name;
  };
  for (const auto& table : tables) {
    if (table.rows() != rows)
      leave_out(left_out.other_rows, table);
    else if (table.columns.size() > most_columns && tables.size() > 1)
      leave_out(left_out.too_wide, table);
    else
      for (const auto& column : table.columns) columns.push_back(&column);
  }
  TextFile out(output);
  for (const auto* column : columns) line += (line.empty() ? "" : ",") + column->heading;
  out.write(line + "\n");
  for (std::size_t i = 0; i < rows; ++i) {
    line.clear();
    for (const auto* column : columns)
      fmt::format_to(std::back_inserter(line), "{}{}", column == columns[0] ? "" : ",", column->values[i]);
    out.write(line + "\n");
  }
  out.commit();
  return left_out;
}

}  // namespace pigment::io
