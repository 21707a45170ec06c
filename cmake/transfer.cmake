# The transfer functions of data/transfer are part of the program, by their files' names, so that it finds
# them wherever it runs.
function(stereonav_embed_transfer target)
  file(GLOB files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/data/transfer/*.txt)
  set(entries "")
  foreach(file ${files})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    get_filename_component(name ${file} NAME_WE)
    file(READ ${file} text)
    string(APPEND entries "        {\"${name}\", R\"text(${text})text\"},\n")
  endforeach()
  set(generated ${CMAKE_BINARY_DIR}/generated/embedded_transfer.cpp)
  file(CONFIGURE OUTPUT ${generated} @ONLY CONTENT [[
// Generated from data/transfer/ by cmake/transfer.cmake.
#include "colon/transfer_presets.h"

namespace stereonav {

std::span<const TransferPreset> transferPresets() {
    static constexpr TransferPreset kPresets[] = {
@entries@    };
    return kPresets;
}

}  // namespace stereonav
]])
  target_sources(${target} PRIVATE ${generated})
endfunction()
