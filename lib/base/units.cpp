#include "base/units.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>

namespace pigment {
namespace {

// In the order of the enumeration.
constexpr DimensionInfo table[] = {
    {Dimension::Number, "number", "1", 1, "0.5"},
    {Dimension::Length, "length", "m", 1e6, "5 nm"},
    {Dimension::Area, "area", "m2", 1e12, "1e-18 m2"},
    {Dimension::Volume, "volume", "m3", 1e18, "1 um3"},
    {Dimension::Time, "time", "s", 1e3, "0.5 s"},
    {Dimension::Temperature, "temperature", "K", 1, "25 degC"},
    {Dimension::Mass, "mass", "kg", 1e12, "1 pg"},
    {Dimension::Density, "density", "kg m-3", 1e-6, "2700 kg/m3"},
    {Dimension::Velocity, "velocity", "m s-1", 1e3, "10 um/s"},
    {Dimension::AngularVelocity, "angular velocity", "s-1", 1e-3, "1 rad/s"},
    {Dimension::Acceleration, "acceleration", "m s-2", 1, "9.81 m/s2"},
    {Dimension::Force, "force", "N", 1e12, "1 pN"},
    {Dimension::Energy, "energy", "J", 1e18, "1e-21 J"},
    {Dimension::Pressure, "pressure", "Pa", 1, "50 kPa"},
    {Dimension::SurfaceTension, "surface tension", "N m-1", 1e6, "72 mN/m"},
    {Dimension::Viscosity, "viscosity", "Pa s", 1e3, "1 mPa s"},
    {Dimension::Potential, "potential", "V", 1e3, "-25 mV"},
    {Dimension::MassFlux, "mass flux", "kg m-2 s-1", 1e-3, "40 g/m2/s"},
    {Dimension::AreaDensity, "mass per area", "kg m-2", 1, "26 g/m2"},
    {Dimension::Concentration, "concentration", "mol m-3", 1, "10 mol/m3"},
    {Dimension::InverseLength, "inverse length", "m-1", 1e-6, "1 um-1"},
    {Dimension::BrownianConstant, "Brownian constant", "N m-1/2", 1e9, "1e-9 N m-1/2"},
    {Dimension::Resistance, "resistance", "N s m-1", 1e9, "1e-8 N s/m"},
    {Dimension::ResistanceCoupling, "coupling resistance", "N s", 1e15, "1e-14 N s"},
    {Dimension::RotationalResistance, "rotational resistance", "N m s", 1e21, "1e-20 N m s"},
    {Dimension::MassFraction, "mass fraction", "1", 1, "65 wt%"},
    {Dimension::VolumeFraction, "volume fraction", "1", 1, "68 vol%"},
};

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

// The unit database, read once. udunits is not thread-safe; the lock is held for each use.
std::mutex& units_lock() {
  static std::mutex lock;
  return lock;
}
ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    return ut_read_xml(nullptr);
  }();
  return system;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

// udunits also reads numbers inside a unit ("3 m"), dates and offsets ("s since 2000-1-1", "K @ 20") and stacked
// prefixes ("nmm"): none of them is a unit that somebody meant to write in a scene.
bool looks_like_unit(std::string_view unit) {
  if (unit.starts_with("1/")) unit.remove_prefix(2);
  char before = ' ';
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const char c = unit[i];
    const auto u = static_cast<unsigned char>(c);
    if (std::isdigit(u)) {
      if (!(std::isalnum(static_cast<unsigned char>(before)) || before == '^' || before == '-' || before == ')'))
        return false;
    } else if (c == '-') {  // only as the sign of an exponent
      if (i + 1 == unit.size() || !std::isdigit(static_cast<unsigned char>(unit[i + 1])) || before == ' ') return false;
    } else if (!(std::isalpha(u) || u >= 0x80 || c == '^' || c == '/' || c == '*' || c == '.' || c == ' ' || c == '(' ||
                 c == ')' || c == '%' || c == '\'' || c == '"')) {
      return false;
    }
    before = c;
  }
  return unit.find("since") == unit.npos && unit.find(" from ") == unit.npos && unit.find(" ref ") == unit.npos &&
         unit.find(" after ") == unit.npos;
}

// Two prefixes on one unit ("nmm"): udunits multiplies them. A word of letters that is not a unit by itself, and not a
// unit after one prefix is taken off, is refused. Called with the lock held.
bool has_stacked_prefix(std::string_view unit) {
  static constexpr std::string_view prefixes[] = {"da", "Y", "Z", "E", "P", "T", "G", "M", "k",  "h",
                                                  "d",  "c", "m", "u", "n", "p", "f", "a", "z", "y", "\xC2\xB5"};
  const auto known = [](std::string_view name) {
    const Unit by_symbol(ut_get_unit_by_symbol(unit_system(), std::string(name).c_str()));
    const Unit by_name(ut_get_unit_by_name(unit_system(), std::string(name).c_str()));
    return by_symbol || by_name;
  };
  std::size_t i = 0;
  while (i < unit.size()) {
    const auto letter = [&](std::size_t k) {
      const auto u = static_cast<unsigned char>(unit[k]);
      return std::isalpha(u) || u >= 0x80;
    };
    if (!letter(i)) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < unit.size() && letter(end)) ++end;
    const std::string_view word = unit.substr(i, end - i);
    i = end;
    if (word.size() > 5 || known(word)) continue;  // long words are spelled-out names: "nanometer"
    bool fine = false;
    for (const auto prefix : prefixes)
      if (word.size() > prefix.size() && word.starts_with(prefix) && known(word.substr(prefix.size()))) fine = true;
    if (!fine) return true;
  }
  return false;
}

UnitConversion fraction_conversion(std::string_view unit, std::string_view word) {
  UnitConversion c;
  const auto is = [&](std::string_view middle) {
    return unit == std::string(word) + std::string(middle) + "%";
  };
  c.ok = true;
  if (unit == "1" || unit.empty())
    c.factor = 1;
  else if (is("") || is("-") || is(" ") || is("."))
    c.factor = 0.01;
  else
    c.ok = false;
  return c;
}

UnitConversion try_convert(std::string_view unit, Dimension dimension) {
  UnitConversion c;
  if (dimension == Dimension::MassFraction) return fraction_conversion(unit, "wt");
  if (dimension == Dimension::VolumeFraction) return fraction_conversion(unit, "vol");
  if (dimension == Dimension::Number) {
    c.ok = unit.empty() || unit == "1";
    return c;
  }
  if (dimension == Dimension::BrownianConstant) {  // udunits has no broken exponents
    for (const char* spelling : {"N m-1/2", "N m^-1/2", "N m^(-1/2)", "N m-0.5", "N m^-0.5", "N/m^0.5", "N/m^(1/2)"})
      c.ok = c.ok || unit == spelling;
    return c;
  }
  if (unit.empty() || !looks_like_unit(unit)) return c;
  const std::lock_guard hold(units_lock());
  ut_system* system = unit_system();
  if (system == nullptr) {
    c.error = "the unit database of udunits2 cannot be read; install libudunits2-data";
    return c;
  }
  if (has_stacked_prefix(unit)) return c;
  const Unit from(ut_parse(system, std::string(unit).c_str(), UT_UTF8));
  const Unit to(ut_parse(system, info(dimension).si_unit, UT_UTF8));
  if (!from || !to || !ut_are_convertible(from.get(), to.get())) return c;
  cv_converter* converter = ut_get_converter(from.get(), to.get());
  if (converter == nullptr) return c;
  const double at0 = cv_convert_double(converter, 0), at1 = cv_convert_double(converter, 1);
  const double at2 = cv_convert_double(converter, 2);
  cv_free(converter);
  // udunits also converts to the reciprocal (s to Hz) and through logarithms; only straight lines are units here.
  // 1e-9: the two slopes of a straight line agree to rounding, those of 1/x or log x differ by a factor.
  if (!std::isfinite(at0) || !std::isfinite(at1) || !(std::abs((at2 - at1) - (at1 - at0)) <= 1e-9 * std::abs(at2)))
    return c;
  c.ok = true;
  c.offset = at0;
  c.factor = at0 == 0 ? at1 : at1 - at0;
  if (at0 != 0 && std::abs(c.factor - 1) < 1e-9) c.factor = 1;  // degC: 274.15 - 273.15 is 1 but for rounding
  return c;
}

std::string with_article(const std::string& name) {
  return (std::string("aeiou").find(name.front()) != std::string::npos ? "an " : "a ") + name;
}

// "5 kPa" where a length is due: say what it is instead.
std::string what_it_is(std::string_view unit) {
  for (const auto& row : table)
    if (row.dimension != Dimension::Number && !unit.empty() && unit != "1" && try_convert(unit, row.dimension).ok)
      return with_article(row.name);
  return {};
}

}  // namespace

const DimensionInfo& info(Dimension dimension) { return table[static_cast<std::size_t>(dimension)]; }

UnitConversion conversion_to_si(std::string_view unit, Dimension dimension) {
  unit = trim(unit);
  UnitConversion c = try_convert(unit, dimension);
  if (!c.ok && c.error.empty()) {
    const std::string other = what_it_is(unit);
    c.error = fmt::format("\"{}\" is not a unit of {}{}; write e.g. \"{}\"", unit, info(dimension).name,
                          other.empty() ? "" : " (but of " + other + ")", info(dimension).si_unit);
  }
  return c;
}

ParsedQuantity parse_quantity(std::string_view text, Dimension dimension) {
  ParsedQuantity result;
  const DimensionInfo& d = info(dimension);
  const std::string_view whole = trim(text);
  const auto fail = [&](const std::string& why) {
    result.error = fmt::format("\"{}\" is not {}{}; write e.g. \"{}\"", whole, with_article(d.name), why, d.example);
    return result;
  };
  std::string_view rest = whole;
  if (rest.starts_with('+') && rest.size() > 1 && rest[1] != '-') rest.remove_prefix(1);
  double value = 0;
  const auto [end, status] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (status == std::errc::result_out_of_range) return fail(" (the number is too large or too small)");
  if (status != std::errc{}) return fail("");
  if (!std::isfinite(value)) return fail(" (it is not finite)");
  const std::string_view unit = trim(rest.substr(static_cast<std::size_t>(end - rest.data())));
  if (unit.empty() && dimension != Dimension::Number) return fail(": its unit is missing");
  const UnitConversion c = try_convert(unit, dimension);
  const bool bare_fraction = unit == "1" && dimension != Dimension::Number;  // "0.65 1" is no way to write a quantity
  if (!c.error.empty()) {
    result.error = c.error;
    return result;
  }
  if (!c.ok || bare_fraction) {
    if (unit == "%" && (dimension == Dimension::MassFraction || dimension == Dimension::VolumeFraction))
      return fail(" (percent of what?)");
    const std::string other = what_it_is(unit);
    return fail(other.empty() ? "" : " (but " + other + ")");
  }
  // Most units are a power of ten below SI's: dividing by 1e6 is right to the last bit where multiplying by 1e-6 is not.
  const double inverse = std::round(1 / c.factor);
  const bool divides = inverse > 1 && std::abs(c.factor * inverse - 1) < 1e-12;
  result.si = (divides ? value / inverse : c.factor * value) + c.offset;
  if (!std::isfinite(result.si)) return fail(" (it is not finite)");
  result.ok = true;
  return result;
}

}  // namespace pigment
