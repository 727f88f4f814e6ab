# Writes a SPIR-V module as a C++ header: -DINPUT=x.spv -DOUTPUT=x.hpp -DSYMBOL=name
file(READ "${INPUT}" bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
string(REGEX REPLACE "(0x........,0x........,0x........,0x........,0x........,0x........,0x........,0x........,)" "\\1\n" words "${words}")
file(WRITE "${OUTPUT}" "// Generated from a shader; do not edit.
#pragma once
#include <cstdint>
namespace brume::spv {
inline constexpr std::uint32_t ${SYMBOL}[] = {
${words}
};
}
")
