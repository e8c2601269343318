# Finds OpenFOAM to compile against: its libraries, its headers, and the definitions both were built with.
#
# Two kinds of installation are supported.
#   Debian's packages     libraries in the system's folders; headers unpacked from the source package by
#                         cases/support/openfoam-headers.sh. A source tree has no include folders, so one
#                         folder of links per library is laid out in the build tree.
#   a sourced OpenFOAM    WM_PROJECT_DIR, FOAM_LIBBIN, FOAM_MPI, WM_PRECISION_OPTION and WM_LABEL_SIZE are
#                         set; every library has its lnInclude folder.
#
# Input (CMake variable or environment variable)
#   HEMOSCALE_OPENFOAM_SOURCE  unpacked source tree; default: build/openfoam-source, then the sourced OpenFOAM
#   OpenFOAM_LIBRARY_DIR       folder of libOpenFOAM.so; default: FOAM_LIBBIN, then the system's folders
# Output
#   OpenFOAM_FOUND, OpenFOAM_VERSION (API number of openfoam.com, e.g. 1912; or the Foundation's number)
#   OpenFOAM_FORK              openfoam.com or foundation
#   OpenFOAM_PROJECT_DIR       value of WM_PROJECT_DIR at run time
#   OpenFOAM_PROBLEM           why it was not found, in words for the user
#   targets OpenFOAM::OpenFOAM OpenFOAM::meshTools OpenFOAM::finiteVolume OpenFOAM::incompressibleTransportModels

set(OpenFOAM_PROBLEM "")

# ---- headers ----------------------------------------------------------------------------------------
set(OpenFOAM_SOURCE_DIR "")
foreach(folder IN ITEMS "${HEMOSCALE_OPENFOAM_SOURCE}" "$ENV{HEMOSCALE_OPENFOAM_SOURCE}"
    "$ENV{FOAM_SRC}/.." "$ENV{WM_PROJECT_DIR}" "${CMAKE_SOURCE_DIR}/build/openfoam-source")
  if(folder AND EXISTS "${folder}/src/OpenFOAM/db/Time/Time.H")
    get_filename_component(OpenFOAM_SOURCE_DIR "${folder}" REALPATH)
    break()
  endif()
endforeach()

# ---- libraries --------------------------------------------------------------------------------------
find_library(OpenFOAM_LIBRARY NAMES OpenFOAM
  HINTS "${OpenFOAM_LIBRARY_DIR}" "$ENV{OpenFOAM_LIBRARY_DIR}" "$ENV{FOAM_LIBBIN}")
get_filename_component(_libraries "${OpenFOAM_LIBRARY}" DIRECTORY)
# Pstream holds the MPI calls. The one in `dummy` has none, so only named folders are searched.
find_library(OpenFOAM_Pstream_LIBRARY NAMES Pstream NO_DEFAULT_PATH
  HINTS "${_libraries}/$ENV{FOAM_MPI}" "${_libraries}/openmpi-system" "${_libraries}/sys-openmpi")
foreach(name fileFormats surfMesh meshTools finiteVolume incompressibleTransportModels)
  find_library(OpenFOAM_${name}_LIBRARY NAMES ${name} HINTS "${_libraries}")
endforeach()
mark_as_advanced(OpenFOAM_LIBRARY OpenFOAM_Pstream_LIBRARY OpenFOAM_fileFormats_LIBRARY
  OpenFOAM_surfMesh_LIBRARY OpenFOAM_meshTools_LIBRARY OpenFOAM_finiteVolume_LIBRARY
  OpenFOAM_incompressibleTransportModels_LIBRARY)

# ---- version ----------------------------------------------------------------------------------------
set(OpenFOAM_VERSION "")
set(OpenFOAM_FORK "")
if(OpenFOAM_SOURCE_DIR)
  if(EXISTS "${OpenFOAM_SOURCE_DIR}/META-INFO/api-info")
    set(OpenFOAM_FORK openfoam.com)
    file(STRINGS "${OpenFOAM_SOURCE_DIR}/META-INFO/api-info" _line REGEX "^api=")
    string(REPLACE "api=" "" OpenFOAM_VERSION "${_line}")
  else()
    set(OpenFOAM_FORK foundation)
    set(OpenFOAM_VERSION "$ENV{WM_PROJECT_VERSION}")
  endif()
endif()

# Debian: do headers and libraries belong together?
find_program(OpenFOAM_DPKG_QUERY dpkg-query)
mark_as_advanced(OpenFOAM_DPKG_QUERY)
set(_packaged "")
if(OpenFOAM_DPKG_QUERY AND OpenFOAM_LIBRARY MATCHES "^(/usr)?/lib/")
  execute_process(COMMAND ${OpenFOAM_DPKG_QUERY} -W -f "\${source:Version}" libopenfoam
    OUTPUT_VARIABLE _packaged ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()

if(NOT OpenFOAM_LIBRARY)
  set(OpenFOAM_PROBLEM "libOpenFOAM.so was not found; install it (Debian: apt-get install --no-install-recommends openfoam), or source the etc/bashrc of an OpenFOAM installation")
elseif(NOT OpenFOAM_Pstream_LIBRARY)
  set(OpenFOAM_PROBLEM "libPstream.so was not found beside ${OpenFOAM_LIBRARY}; source the OpenFOAM installation so that FOAM_MPI is set")
elseif(NOT OpenFOAM_SOURCE_DIR)
  set(OpenFOAM_PROBLEM "the libraries are here (${OpenFOAM_LIBRARY}), the headers are not; fetch them with cases/support/openfoam-headers.sh, or set HEMOSCALE_OPENFOAM_SOURCE to a source tree of the same version")
elseif(OpenFOAM_FORK STREQUAL "foundation")
  set(OpenFOAM_PROBLEM "${OpenFOAM_SOURCE_DIR} is OpenFOAM ${OpenFOAM_VERSION} of the Foundation; the plug-in is written for the openfoam.com line (v1912 and later)")
elseif(OpenFOAM_VERSION VERSION_LESS 1912)
  set(OpenFOAM_PROBLEM "${OpenFOAM_SOURCE_DIR} is OpenFOAM ${OpenFOAM_VERSION}; v1912 or later is needed")
elseif(_packaged AND NOT _packaged MATCHES "^([0-9]+:)?${OpenFOAM_VERSION}[.]")
  set(OpenFOAM_PROBLEM "the headers in ${OpenFOAM_SOURCE_DIR} are those of v${OpenFOAM_VERSION}, the installed package is ${_packaged}; remove that folder and run cases/support/openfoam-headers.sh")
endif()

# ---- definitions ------------------------------------------------------------------------------------
set(_precision DP)
if(DEFINED ENV{WM_PRECISION_OPTION})
  set(_precision $ENV{WM_PRECISION_OPTION})
endif()
set(_label_size 32)
if(DEFINED ENV{WM_LABEL_SIZE})
  set(_label_size $ENV{WM_LABEL_SIZE})
endif()
set(_definitions OPENFOAM=${OpenFOAM_VERSION} WM_${_precision} WM_LABEL_SIZE=${_label_size} NoRepository)

set(OpenFOAM_PROJECT_DIR "")
foreach(folder IN ITEMS "$ENV{WM_PROJECT_DIR}" /usr/share/openfoam)
  if(NOT OpenFOAM_PROJECT_DIR AND folder AND EXISTS "${folder}/etc/controlDict")
    set(OpenFOAM_PROJECT_DIR "${folder}")
  endif()
endforeach()

# The include folder of one library: its lnInclude, or a folder of links in the build tree. Templates
# include .C files, so these are linked too. One folder for all would not do: names collide.
function(_openfoam_include library result)
  set(source "${OpenFOAM_SOURCE_DIR}/src/${library}")
  if(IS_DIRECTORY "${source}/lnInclude")
    set(${result} "${source}/lnInclude" PARENT_SCOPE)
    return()
  endif()
  string(REPLACE "/" "_" name "${library}")
  set(farm "${CMAKE_BINARY_DIR}/openfoam-include/${name}")
  set(${result} "${farm}" PARENT_SCOPE)
  set(laid_out "")
  if(EXISTS "${farm}/.made-from")
    file(READ "${farm}/.made-from" laid_out)
  endif()
  if(NOT laid_out STREQUAL "${source} ${OpenFOAM_VERSION}")
    file(REMOVE_RECURSE "${farm}")
    file(MAKE_DIRECTORY "${farm}")
    execute_process(
      COMMAND find "${source}" "(" -name Make -o -name noLink ")" -prune -o -name "*.[CH]" -print0
      COMMAND xargs -0 ln -sf -t "${farm}"
      RESULTS_VARIABLE codes)
    if(NOT codes MATCHES "^0;0$")
      message(FATAL_ERROR "cannot make links to ${source} in ${farm}")
    endif()
    file(WRITE "${farm}/.made-from" "${source} ${OpenFOAM_VERSION}")
  endif()
endfunction()

# _openfoam_target(name dependencies source-folder...); imported: its includes are SYSTEM includes
function(_openfoam_target name dependencies)
  set(library "${OpenFOAM_${name}_LIBRARY}")
  if(name STREQUAL "OpenFOAM")
    set(library "${OpenFOAM_LIBRARY}")
  endif()
  set(includes "")
  foreach(folder IN LISTS ARGN)
    _openfoam_include(${folder} include)
    list(APPEND includes "${include}")
  endforeach()
  add_library(OpenFOAM::${name} SHARED IMPORTED)
  set_target_properties(OpenFOAM::${name} PROPERTIES IMPORTED_LOCATION "${library}" IMPORTED_NO_SONAME TRUE
    INTERFACE_INCLUDE_DIRECTORIES "${includes}" INTERFACE_LINK_LIBRARIES "${dependencies}")
endfunction()

include(FindPackageHandleStandardArgs)
string(REPLACE ";" "," _reason "${OpenFOAM_PROBLEM}")  # it would be taken for a list below
set(OpenFOAM_usable TRUE)
if(NOT OpenFOAM_PROBLEM STREQUAL "")
  set(OpenFOAM_usable FALSE)
endif()
find_package_handle_standard_args(OpenFOAM REQUIRED_VARS OpenFOAM_LIBRARY OpenFOAM_SOURCE_DIR
  OpenFOAM_Pstream_LIBRARY OpenFOAM_finiteVolume_LIBRARY OpenFOAM_meshTools_LIBRARY
  OpenFOAM_incompressibleTransportModels_LIBRARY OpenFOAM_usable
  VERSION_VAR OpenFOAM_VERSION REASON_FAILURE_MESSAGE "${_reason}")

if(OpenFOAM_FOUND AND NOT TARGET OpenFOAM::OpenFOAM)
  _openfoam_target(Pstream "")
  _openfoam_target(OpenFOAM "OpenFOAM::Pstream;${CMAKE_DL_LIBS}" OpenFOAM OSspecific/POSIX)
  set_target_properties(OpenFOAM::OpenFOAM PROPERTIES INTERFACE_COMPILE_DEFINITIONS "${_definitions}")
  _openfoam_target(fileFormats OpenFOAM::OpenFOAM fileFormats)
  _openfoam_target(surfMesh OpenFOAM::fileFormats surfMesh)
  _openfoam_target(meshTools OpenFOAM::surfMesh meshTools)
  _openfoam_target(finiteVolume OpenFOAM::meshTools finiteVolume)
  _openfoam_target(incompressibleTransportModels OpenFOAM::finiteVolume transportModels/incompressible)
  # some headers are written with their folder, "incompressible/..."
  set_property(TARGET OpenFOAM::incompressibleTransportModels APPEND PROPERTY
    INTERFACE_INCLUDE_DIRECTORIES "${OpenFOAM_SOURCE_DIR}/src/transportModels")
endif()
