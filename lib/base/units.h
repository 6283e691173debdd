#pragma once
// The one unit set of the engine, the dimensions a scene or a file may ask for, and the physical constants.
//
// Engine units: micrometre, millisecond, piconewton, millivolt, kelvin. Then 1 Pa = 1 pN/um^2,
// 1 mPa s = 1 pN ms/um^2, 1 mN/m = 1000 pN/um, 1 pN um = 1e-18 J; mass in pN ms^2/um = 1e-12 kg.
// A bare double anywhere in lib/ is in these units; any other unit is in the name of the variable.
#include <string>
#include <string_view>

namespace pigment {

enum class Dimension {
  Number,            // dimensionless
  Length,            // m
  Area,              // m2 (permeability)
  Volume,            // m3
  Time,              // s
  Temperature,       // K
  Mass,              // kg
  Density,           // kg m-3
  Velocity,          // m s-1 (also a volume flux, m3/m2/s)
  AngularVelocity,   // s-1
  Acceleration,      // m s-2
  Force,             // N
  Energy,            // J
  Pressure,          // Pa
  SurfaceTension,    // N m-1
  Viscosity,         // Pa s
  Potential,         // V
  MassFlux,          // kg m-2 s-1
  AreaDensity,       // kg m-2 (coat weight)
  Concentration,     // mol m-3
  InverseLength,     // m-1: a density of lengths
  BrownianConstant,  // N m-1/2, K_Brown of (25)
  Resistance,        // N s m-1: force by velocity
  ResistanceCoupling,   // N s: force by angular velocity, torque by velocity
  RotationalResistance, // N m s: torque by angular velocity
  MassFraction,      // 1, written "65 wt%"
  VolumeFraction,    // 1, written "68 vol%"
};

struct DimensionInfo {
  Dimension dimension;
  const char* name;        // "length": for messages, "is not a length"
  const char* si_unit;     // as udunits reads it and as files carry it: "m", "kg m-3", "1"
  double engine_per_si;    // engine value = si value * engine_per_si
  const char* example;     // "5 nm": for messages, "write e.g. ..."
};
const DimensionInfo& info(Dimension);

inline double to_engine(Dimension d, double si) { return si * info(d).engine_per_si; }
inline double to_si(Dimension d, double engine) { return engine / info(d).engine_per_si; }

struct ParsedQuantity {
  bool ok = false;
  double si = 0;      // value in info(d).si_unit
  std::string error;  // when not ok: "\"5 nmm\" is not a length; write e.g. \"5 nm\""
};
// Reads a number and its unit ("25 degC", "65 wt%", "1e-18 m2", "40 g/m2/s"). A bare number is an error unless the
// dimension is Number. Not-a-number and infinity are errors.
ParsedQuantity parse_quantity(std::string_view text, Dimension);

// Factor and offset that take a value in `unit` (a udunits string, "wt%" or "vol%") to info(d).si_unit:
// si = factor * value + offset. ok is false where the unit is unknown or of another dimension.
struct UnitConversion {
  bool ok = false;
  double factor = 1, offset = 0;
  std::string error;
};
UnitConversion conversion_to_si(std::string_view unit, Dimension);

namespace constants {  // CODATA 2018; the first three are exact
inline constexpr double boltzmann_si = 1.380649e-23;            // J/K
inline constexpr double avogadro_si = 6.02214076e23;            // 1/mol
inline constexpr double elementary_charge_si = 1.602176634e-19; // C
inline constexpr double vacuum_permittivity_si = 8.8541878128e-12;  // F/m
inline constexpr double boltzmann = boltzmann_si * 1e18;        // pN um / K
// 1 F/m = 1 N/V^2 = 1e12 pN / 1e6 mV^2
inline constexpr double vacuum_permittivity = vacuum_permittivity_si * 1e6;  // pN / mV^2
}  // namespace constants

}  // namespace pigment
