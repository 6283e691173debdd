#include "io/export.h"

#include "io/h5.h"
#include "io/particle_file.h"
#include "lib/io/io_test_support.h"

namespace pigment::io {
namespace {

using namespace test;
namespace fs = std::filesystem;

fs::path packing(const fs::path& folder) {
  Layer layer;
  layer.cell = {4, 5, 10};
  layer.particles = {{0.5, 0.25}, {0.1, 0.2}, {0, 1}, {7, 3}};
  layer.position = {{-1, 1, 1}, {2, 12, 2}};  // wrapped: 3 and 2
  write_packing(folder / "packing.h5", layer, {"calcium carbonate", "latex"}, {}, {});
  return folder / "packing.h5";
}

TEST(Export, XyzIsWrappedAndInMicrometres) {
  const fs::path folder = fresh_folder();
  export_xyz(ParticleFile(packing(folder)), folder / "p.xyz");
  EXPECT_EQ(bytes_of(folder / "p.xyz"),
            "2\nLattice=\"4 0 0 0 5 0 0 0 10\" Origin=\"0 0 0\" pbc=\"T T F\" "
            "Properties=species:S:1:pos:R:3:Radius:R:1:id:I:1 Time=0 Step=0 length_unit=um time_unit=s\n"
            "calcium_carbonate 3 1 1 0.5 7\nlatex 2 2 2 0.25 3\n");
}

TEST(Export, XdmfPointsIntoTheFileAndWrapsInTheText) {
  const fs::path folder = fresh_folder();
  fs::create_directories(folder / "pictures");
  export_xdmf(ParticleFile(packing(folder)), folder / "pictures/p.xdmf");
  const std::string text = bytes_of(folder / "pictures/p.xdmf");
  expect_contains(text, "Format=\"HDF\">../packing.h5:/particles/layer/radius</DataItem>");
  expect_contains(text, "Format=\"XML\">\n3e-06 1e-06 1e-06\n2e-06 2e-06 2e-06\n</DataItem>");
}

TEST(Export, H5mdIsWrappedAndInNanometres) {
  const fs::path folder = fresh_folder();
  export_h5md(ParticleFile(packing(folder)), folder / "p.h5");
  const h5::InputFile file(folder / "p.h5");
  const auto position = file.doubles("/particles/layer/position/value");
  ASSERT_EQ(position.size(), 6u);
  EXPECT_DOUBLE_EQ(position[0], 3000);
  EXPECT_DOUBLE_EQ(position[4], 2000);
  EXPECT_EQ(file.shape("/particles/layer/box/edges/value"), (h5::Extent{1, 3, 3}));
  EXPECT_DOUBLE_EQ(file.doubles("/particles/layer/box/edges/value")[4], 5000);
  EXPECT_DOUBLE_EQ(file.doubles("/observables/radius/value")[1], 250);
  EXPECT_EQ(file.text_attribute("/particles/layer/position/value", "unit"), "nm");
  EXPECT_THROW(ParticleFile(folder / "p.h5"), FileError);
}

TEST(Export, CsvStandsDatasetsSideBySide) {
  const fs::path folder = fresh_folder(), input = folder / "solids.h5", output = folder / "out.csv";
  ResultFile result;
  result.kind = "solids";
  result.datasets = {{"/solids/time", {2}, {0, 500}, Dimension::Time, Dataset::Storage::Float64},
                     {"/solids/fraction",
                      {2, 2},
                      {0.1, 0.2, 0.3, 0.4},
                      Dimension::VolumeFraction,
                      Dataset::Storage::Float64},
                     {"/solids/edges", {3}, {0, 1, 2}, Dimension::Length, Dataset::Storage::Float64}};
  write_result(input, result);
  EXPECT_EQ(export_csv(input, "", output).other_rows, "edges");
  EXPECT_EQ(bytes_of(output), "time [s],fraction_0 [1],fraction_1 [1]\n0,0.1,0.2\n0.5,0.3,0.4\n");
  EXPECT_EQ(export_csv(input, "/solids/edges", output).other_rows, "");
  EXPECT_EQ(bytes_of(output), "edges [m]\n0\n1e-06\n2e-06\n");
  EXPECT_THROW(export_csv(input, "/solids/absent", output), FileError);
  EXPECT_EQ(export_csv(packing(folder), "", output).other_rows, "");
  const std::string table = bytes_of(output);
  EXPECT_EQ(table.substr(0, table.find('\n')),
            "id [1],mass [kg],position_0 [m],position_1 [m],position_2 [m],radius [m],species [1]");
}

}  // namespace
}  // namespace pigment::io
