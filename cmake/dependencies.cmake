# Every outside library is found here and nowhere else; lib/CMakeLists.txt says which room may use which.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(CLI11 REQUIRED)
find_package(GSL REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(HDF5 1.10 REQUIRED COMPONENTS C)
find_package(PNG REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)  # SHA-256 of input files

# Libraries whose Debian packages ship no CMake package.
function(pigment_find_plain target header library)
  find_path(${target}_INCLUDE ${header} PATH_SUFFIXES suitesparse REQUIRED)
  add_library(pigment_${target} INTERFACE)
  target_include_directories(pigment_${target} SYSTEM INTERFACE ${${target}_INCLUDE})
  if(NOT library STREQUAL "HEADER_ONLY")
    find_library(${target}_LIBRARY ${library} REQUIRED)
    target_link_libraries(pigment_${target} INTERFACE ${${target}_LIBRARY})
  endif()
endfunction()
pigment_find_plain(cholmod cholmod.h cholmod)
pigment_find_plain(udunits2 udunits2.h udunits2)
pigment_find_plain(voro voro++/voro++.hh voro++)
pigment_find_plain(random123 Random123/philox.h HEADER_ONLY)

add_library(pigment_hdf5 INTERFACE)
target_include_directories(pigment_hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
target_link_libraries(pigment_hdf5 INTERFACE ${HDF5_C_LIBRARIES})
