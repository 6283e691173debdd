#pragma once
// Files of lib/report/page that the page carries: embedded when building (cmake/embed.cmake).
#include <string_view>

namespace pigment::report {

extern const std::string_view page_clock_js, page_plots_js;  // every page
extern const std::string_view page_viewer_css, page_three_min_js, page_layer_data_js, page_layer_scene_js,
    page_viewer_colours_js, page_viewer_js;  // pages with a 3-D viewer

}  // namespace pigment::report
