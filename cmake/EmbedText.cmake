# Writes a text file as a C++ string: -DINPUT=x.json -DOUTPUT=x.hpp -DSYMBOL=name
file(READ "${INPUT}" text)
file(WRITE "${OUTPUT}" "// Generated from a text file; do not edit.
#pragma once
namespace brume::text {
inline constexpr char ${SYMBOL}[] = R\"embedded(${text})embedded\";
}
")
