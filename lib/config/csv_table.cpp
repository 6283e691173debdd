#include "config/csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "base/error.h"

namespace pigment::config {
namespace {

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  for (std::size_t begin = 0;;) {
    const auto comma = line.find(',', begin);
    fields.push_back(trimmed(line.substr(begin, comma == std::string::npos ? comma : comma - begin)));
    if (comma == std::string::npos) return fields;
    begin = comma + 1;
  }
}

std::string header_of(const std::vector<CsvColumn>& columns) {
  std::string text;
  for (const CsvColumn& c : columns) {
    // The example of the dimension ends in its unit ("5 nm").
    const std::string example = info(c.dimension).example;
    const auto space = example.find(' ');
    if (!text.empty()) text += ",";
    text += c.name + (space == std::string::npos ? "" : " [" + example.substr(space + 1) + "]");
  }
  return text;
}

struct Header {
  std::vector<CsvColumn> columns;
  std::vector<UnitConversion> conversion;
};

Header read_header(const std::string& where, const std::string& line,
                   const std::vector<CsvColumn>& expected) {
  const std::string wanted = "; expected a header such as \"" + header_of(expected) + "\"";
  Header header;
  for (const std::string& field : fields_of(line)) {
    const auto bracket = field.find('[');
    const std::string name = trimmed(field.substr(0, bracket));
    const auto known =
        std::find_if(expected.begin(), expected.end(), [&](const CsvColumn& c) { return c.name == name; });
    if (known == expected.end()) throw FileError(where + "unknown column \"" + field + "\"" + wanted);
    for (const CsvColumn& c : header.columns)
      if (c.name == name) throw FileError(where + "column \"" + name + "\" stands twice" + wanted);
    UnitConversion conversion{true, 1, 0, {}};
    if (bracket != std::string::npos) {
      if (field.back() != ']') throw FileError(where + "column \"" + field + "\" lacks a closing ]" + wanted);
      const std::string unit = trimmed(field.substr(bracket + 1, field.size() - bracket - 2));
      conversion = conversion_to_si(unit, known->dimension);
      if (!conversion.ok)
        throw FileError(where + "column \"" + name + "\": [" + unit + "] is not a unit of " +
                        info(known->dimension).name + wanted);
    } else if (known->dimension != Dimension::Number) {
      throw FileError(where + "column \"" + name + "\" names no unit" + wanted);
    }
    header.columns.push_back(*known);
    header.conversion.push_back(conversion);
  }
  for (const CsvColumn& c : expected)
    if (c.required && std::none_of(header.columns.begin(), header.columns.end(),
                                   [&](const CsvColumn& h) { return h.name == c.name; }))
      throw FileError(where + "no column \"" + c.name + "\"" + wanted);
  return header;
}

// SI value of a field.
double read_field(const std::string& where, const CsvColumn& column, const UnitConversion& conversion,
                  const std::string& field) {
  for (const auto& [word, value] : column.words)
    if (field == word) return value;
  // from_chars knows no leading plus; locales do not touch it.
  const char* begin = field.data() + (field.size() > 1 && field[0] == '+' && field[1] != '-');
  double value = 0;
  const auto [end, status] = std::from_chars(begin, field.data() + field.size(), value);
  if (status != std::errc{} || end != field.data() + field.size() || !std::isfinite(value)) {
    std::string words;
    for (const auto& w : column.words) words += " or \"" + w.first + "\"";
    throw FileError(where + "column \"" + column.name + "\": \"" + field + "\" is not a finite number" +
                    (words.empty() ? "" : "; expected one" + words));
  }
  return conversion.factor * value + conversion.offset;
}

}  // namespace

const std::vector<double>* CsvTable::find(const std::string& name) const {
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c].name == name) return &values[c];
  return nullptr;
}

void CsvTable::fail(std::size_t row, const std::string& message) const {
  throw FileError(file.string() + ":" + std::to_string(line.at(row)) + ": " + message);
}

CsvTable read_csv(const std::filesystem::path& path, const std::vector<CsvColumn>& expected) {
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path)) throw FileError(path.string() + ": cannot be read");
  CsvTable table{path, {}, {}, {}};
  Header header;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // byte order mark of some editors
    const std::string text = trimmed(line);
    if (text.empty() || text[0] == '#') continue;
    const std::string where = path.string() + ":" + std::to_string(number) + ": ";
    if (header.columns.empty()) {
      header = read_header(where, text, expected);
      table.columns = header.columns;
      table.values.resize(header.columns.size());
      continue;
    }
    const auto fields = fields_of(text);
    if (fields.size() != header.columns.size())
      throw FileError(where + "expected " + std::to_string(header.columns.size()) +
                      " fields as in the header, found " + std::to_string(fields.size()));
    for (std::size_t c = 0; c < fields.size(); ++c) {
      const double si = read_field(where, header.columns[c], header.conversion[c], fields[c]);
      table.values[c].push_back(to_engine(header.columns[c].dimension, si));
    }
    table.line.push_back(number);
  }
  if (in.bad()) throw FileError(path.string() + ": cannot be read");
  if (header.columns.empty())
    throw FileError(path.string() + ": is empty; expected a header such as \"" + header_of(expected) + "\"");
  if (table.line.empty()) throw FileError(path.string() + ": has a header and no rows");
  return table;
}

}  // namespace pigment::config
