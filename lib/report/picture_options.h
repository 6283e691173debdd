#pragma once
// What a user may ask of a picture, read from text. All throw InputError naming the option, what was found
// and what is expected.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/units.h"
#include "io/particle_file.h"
#include "report/layer_picture.h"

namespace pigment::report {

double quantity_option(const std::string& option, const std::string& text, Dimension);  // engine units
int whole_option(const std::string& option, int value, int least, int most);
double range_option(const std::string& option, double value, double least, double most);
View view_option(const std::string&);                  // side, top, oblique
std::pair<int, int> size_option(const std::string&);   // "1600x1200"
std::vector<AxisCut> cuts_option(const std::string&);  // "y=2.5um", "x<1 um,z>2um"; empty: none
// Numbers of the frames that these ask for; the last frame where none does. times: ms, one a frame.
std::vector<std::size_t> frames_option(const std::vector<double>& times, const std::string& frame,
                                       const std::string& time, const std::string& frames, int contact_sheet);
// The height that holds every one of these frames: one scale for all.
double framed_height(const io::ParticleFile&, const std::vector<std::size_t>& frames);
// NAME.png -> NAME.0012.png
std::filesystem::path numbered(const std::filesystem::path&, std::size_t frame);

}  // namespace pigment::report
