# Fails if a folder includes or links against one that stands to its left:
#
#     cases -> postproc -> solver -> mesh -> physics
#
# cmake -DROOT=<checkout> -P check_arrows.cmake
cmake_minimum_required(VERSION 3.25)

set(folders physics mesh solver postproc cases) # each may use those before it
set(targets pfdm_physics pfdm_mesh pfdm_solver pfdm_postproc pfdm_program)
set(complaints "")

# Includes of one source file: each must begin with the name of a folder that this one may use.
function(check_includes folder file)
  list(FIND folders ${folder} own_rank)
  file(STRINGS "${ROOT}/${file}" lines REGEX "^[ \t]*#[ \t]*include")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "include[ \t]*([\"<])([^\">]+)[\">]")
      continue()
    endif()
    set(quote "${CMAKE_MATCH_1}")
    set(header "${CMAKE_MATCH_2}")
    string(REGEX REPLACE "/.*" "" first "${header}")
    list(FIND folders "${first}" rank)
    if(rank GREATER own_rank)
      list(APPEND complaints "${file} includes ${header}: ${folder} must not know ${first}")
    elseif(quote STREQUAL "\"" AND rank EQUAL -1)
      list(APPEND complaints "${file} includes \"${header}\": paths start with a folder of the top level")
    endif()
  endforeach()
  set(complaints "${complaints}" PARENT_SCOPE)
endfunction()

# The project's own targets that a folder's CMakeLists.txt names.
function(check_links folder file)
  list(FIND folders ${folder} own_rank)
  file(STRINGS "${ROOT}/${file}" lines)
  list(TRANSFORM lines REPLACE "#.*" "")
  string(REGEX MATCHALL "pfdm_[a-z_]+" names "${lines}")
  list(REMOVE_DUPLICATES names)
  foreach(name IN LISTS names)
    list(FIND targets ${name} rank)
    if(rank GREATER own_rank)
      list(APPEND complaints "${file} links ${name}: ${folder} must not know it")
    endif()
  endforeach()
  set(complaints "${complaints}" PARENT_SCOPE)
endfunction()

set(n_sources 0)
foreach(folder IN LISTS folders)
  file(GLOB_RECURSE sources RELATIVE "${ROOT}" "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cpp")
  foreach(file IN LISTS sources)
    check_includes(${folder} "${file}")
    math(EXPR n_sources "${n_sources} + 1")
  endforeach()
  file(GLOB_RECURSE lists RELATIVE "${ROOT}" "${ROOT}/${folder}/CMakeLists.txt" "${ROOT}/${folder}/*.cmake")
  foreach(file IN LISTS lists)
    check_links(${folder} "${file}")
  endforeach()
endforeach()

if(n_sources EQUAL 0)
  message(FATAL_ERROR "no sources below ${ROOT}")
endif()
if(complaints)
  list(JOIN complaints "\n" text)
  message(FATAL_ERROR "${text}")
endif()
message(STATUS "${n_sources} files keep to the arrows")
