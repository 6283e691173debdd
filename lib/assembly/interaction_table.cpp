#include "assembly/interaction_table.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "config/csv_table.h"

namespace pigment::assembly {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

enum { A1, A2, H };
const std::vector<config::CsvColumn> csv_columns = {
    {"a1", Dimension::Number, true, {}},
    {"a2", Dimension::Number, true, {{"inf", infinity}, {"surface", -infinity}}},
    {"h", Dimension::Number, true, {}}};

struct Row {
  double value[3];  // as written, m; a2 as in csv_columns
  Facing facing;
  double gap;
};

Row row_at(const config::CsvTable& table, std::size_t k, double potential) {
  Row row{};
  for (int c : {A1, A2, H}) {
    const double x = row.value[c] = (*table.find(csv_columns[c].name))[k];
    const auto refuse = [&](const std::string& expected) {
      table.fail(k, fmt::format("column \"{}\": {} m is not {}", csv_columns[c].name, x, expected));
    };
    if (c == H && std::abs(x) > 1) refuse("a gap; expected -1 to 1 m");
    if (c != H && std::isfinite(x) && !(x >= 1e-12 && x <= 1)) refuse("a radius; expected 1e-12 to 1 m");
  }
  const double a2 = row.value[A2];
  row.gap = to_engine(Dimension::Length, row.value[H]);
  row.facing = {std::isfinite(a2) ? Partner::Sphere : a2 > 0 ? Partner::Wall : Partner::Surface,
                to_engine(Dimension::Length, row.value[A1]), std::isfinite(a2) ? to_engine(Dimension::Length, a2) : 0,
                potential, potential};
  return row;
}

std::string line_of(const Row& row, const InteractionEvaluator& evaluator) {
  const auto text = [](double x) { return fmt::format("{:.17g}", x + 0.0); };  // + 0: no -0
  const auto si = [&](Dimension d, double x) { return text(to_si(d, x)); };
  const double a2 = row.value[A2];
  const std::string partner = std::isfinite(a2) ? text(a2) : a2 > 0 ? "inf" : "surface";
  const ResistanceScalars k = evaluator.resistance(row.facing, row.gap);
  std::string line = fmt::format("{},{},{},{},{},{},{},{}", text(row.value[A1]), partner, text(row.value[H]),
                                 si(Dimension::Resistance, k.kn), si(Dimension::RotationalResistance, k.kt),
                                 si(Dimension::Resistance, k.ks), si(Dimension::RotationalResistance, k.kp),
                                 si(Dimension::ResistanceCoupling, k.ksp));
  for (const char* law : {"electrostatic", "van_der_waals", "born", "steric"})
    line += "," + si(Dimension::Force, evaluator.colloidal(law, row.facing, row.gap).force);
  return line + "," + si(Dimension::Force, evaluator.total(row.facing, row.gap).force) + "\n";
}

}  // namespace

std::string evaluate_table(const std::filesystem::path& csv, const InteractionEvaluator& evaluator, double potential) {
  const config::CsvTable table = config::read_csv(csv, csv_columns);
  std::string text = "a1,a2,h,kn,kt,ks,kp,ksp,f_electrostatic,f_vdw,f_born,f_steric,f_total\n";
  for (std::size_t k = 0; k < table.row_count(); ++k) text += line_of(row_at(table, k, potential), evaluator);
  return text;
}

}  // namespace pigment::assembly
