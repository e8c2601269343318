# hypre: algebraic multigrid for distributed systems (Debian gives it no CMake package).
# Gives HYPRE::HYPRE (private to the library that links it: no header of ours includes it).
find_path(HYPRE_INCLUDE_DIR HYPRE_parcsr_ls.h PATH_SUFFIXES hypre)
find_library(HYPRE_LIBRARY HYPRE)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(HYPRE REQUIRED_VARS HYPRE_LIBRARY HYPRE_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install libhypre-dev (cases/support/packages.txt)")
mark_as_advanced(HYPRE_INCLUDE_DIR HYPRE_LIBRARY)
if(HYPRE_FOUND AND NOT TARGET HYPRE::HYPRE)
  add_library(HYPRE::HYPRE INTERFACE IMPORTED GLOBAL)
  target_include_directories(HYPRE::HYPRE SYSTEM INTERFACE ${HYPRE_INCLUDE_DIR})
  target_link_libraries(HYPRE::HYPRE INTERFACE ${HYPRE_LIBRARY})
endif()
