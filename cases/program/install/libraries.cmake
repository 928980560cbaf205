# The libraries that pfdm is made of: for its own build, and for projects that link an installed pfdm.

find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel IOCore IOXML IOLegacy FiltersCore)
find_package(Freetype REQUIRED) # Cairo's headers include its
find_package(spdlog REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(muparser REQUIRED)
find_package(Boost 1.74 REQUIRED) # headers only: Odeint
find_package(Ceres 2.1 REQUIRED)

# TetGen, SuiteSparse, UDUNITS-2, FFTW, Cairo, matio, libsndfile and the serial HDF5 ship no CMake package in Debian 12.
function(pfdm_import_library target header library)
  find_path(${target}_INCLUDE_DIR ${header} PATH_SUFFIXES suitesparse udunits2 cairo hdf5/serial REQUIRED)
  find_library(${target}_LIBRARY ${library} REQUIRED)
  add_library(${target} INTERFACE IMPORTED)
  target_include_directories(${target} SYSTEM INTERFACE ${${target}_INCLUDE_DIR})
  target_link_libraries(${target} INTERFACE ${${target}_LIBRARY})
endfunction()
pfdm_import_library(external_tetgen tetgen.h tet)
target_compile_definitions(external_tetgen INTERFACE TETLIBRARY)
pfdm_import_library(external_cholmod cholmod.h cholmod)
pfdm_import_library(external_umfpack umfpack.h umfpack)
pfdm_import_library(external_udunits udunits2.h udunits2)
pfdm_import_library(external_fftw fftw3.h fftw3)
pfdm_import_library(external_cairo cairo.h cairo)
pfdm_import_library(external_matio matio.h matio)
pfdm_import_library(external_sndfile sndfile.h sndfile)
pfdm_import_library(external_hdf5 hdf5.h hdf5_serial)
target_compile_definitions(external_hdf5 INTERFACE H5_USE_110_API) # which newer releases have too

find_package(CGAL 5.5 REQUIRED) # the last: it looks at the flags of the targets that it finds
