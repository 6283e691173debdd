#pragma once
// Particle files and results in the forms that other programs read. x and y are wrapped into the box.
#include <filesystem>
#include <string>

namespace pigment::io {

class ParticleFile;

// ParaView (the reader named "XDMF Reader"): an XML text that points into the HDF5 file, which must stay
// where it is; SI units. Point data: radius, species, id, and velocities where the file has them. Positions
// lie in the text itself for frames in which a particle has left the box through a side.
void export_xdmf(const ParticleFile&, const std::filesystem::path& output);

// OVITO: extended XYZ, one block a frame, in um, s and um/s: species, position, Radius, id, and velocity
// where the file has it.
void export_xyz(const ParticleFile&, const std::filesystem::path& output);

// MDAnalysis: H5MD in nm, ns and nm/ns, edges as 3 x 3 matrices, and the radius, which H5MD has no name for,
// as the observable `radius`. Where velocities are known they are there.
void export_h5md(const ParticleFile&, const std::filesystem::path& output);

// Spreadsheets: the one-dimensional datasets of a group side by side (value of a time-dependent element), and
// the columns of two-dimensional ones, each headed "name [unit]" in SI; or one dataset. `object` is a path in
// the file; empty: /observables of a trajectory, /particles/layer of a packing, else the group that the file
// is about. Throws FileError where nothing there can stand in a table. Returns the names of what was left out of a
// group, for a message: for its number of rows, or for its more than 1000 columns.
struct CsvLeftOut {
  std::string other_rows, too_wide;
};
CsvLeftOut export_csv(const std::filesystem::path& input, const std::string& object,
                       const std::filesystem::path& output);

}  // namespace pigment::io
