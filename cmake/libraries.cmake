# RADIOSITY_LIBRARIES: what the program is built with, as `radiosity --version` tells it.

# The word after `#define NAME` in a header of a library whose package tells no version.
function(read_version result header name)
  set(line "")
  if(EXISTS "${header}")
    file(STRINGS "${header}" line REGEX "#define[ \t]+${name}[ \t]" LIMIT_COUNT 1)
  endif()
  string(REGEX REPLACE ".*${name}[ \t]+\"?([^ \"]+).*" "\\1" version "${line}")
  set(${result} "${version}" PARENT_SCOPE)
endfunction()

find_path(OPENMESH_INCLUDE_DIR OpenMesh/Core/System/config.h)
read_version(openmesh ${OPENMESH_INCLUDE_DIR}/OpenMesh/Core/System/config.h OM_VERSION)
# 0x90000 is 9.0
math(EXPR openmesh_major "(${openmesh} + 0) >> 16")
math(EXPR openmesh_minor "((${openmesh} + 0) >> 8) & 255")

set(libraries
    "Embree ${EMBREE_VERSION}" "TBB ${TBB_VERSION}" "Eigen ${Eigen3_VERSION}"
    "OpenMesh ${openmesh_major}.${openmesh_minor}" "VTK ${VTK_VERSION}" "HDF5 ${HDF5_VERSION}"
    "libpng ${PNG_VERSION_STRING}" "OpenEXR ${OpenEXR_VERSION}" "fmt ${fmt_VERSION}"
    "nlohmann-json ${nlohmann_json_VERSION}" "CLI11 ${CLI11_VERSION}")
if(RADIOSITY_BUILD_VIEWER)
  read_version(imgui ${IMGUI_INCLUDE_DIR}/imgui.h IMGUI_VERSION)
  list(APPEND libraries "GLFW ${glfw3_VERSION}" "Dear ImGui ${imgui}")
endif()
list(JOIN libraries ", " RADIOSITY_LIBRARIES)
