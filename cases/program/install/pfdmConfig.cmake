# find_package(pfdm) of an installed pfdm: the targets pfdm::physics, pfdm::mesh, pfdm::solver and pfdm::postproc, and
# those of the rooms in the last two, as pfdm::solver_fracture; pfdm::program_fracture reads cases from
# their folders. The project that asks has to have the languages C and
# CXX, as VTK wants.
include(${CMAKE_CURRENT_LIST_DIR}/libraries.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/pfdmTargets.cmake)
