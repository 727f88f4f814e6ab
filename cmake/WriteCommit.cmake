# Writes the version and the git commit as a header: -DSOURCE=root -DOUTPUT=x.hpp -DVERSION=1.2.3
cmake_policy(VERSION 3.25)
execute_process(COMMAND git -C "${SOURCE}" rev-parse --short=8 HEAD
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "unknown")
else()
  execute_process(COMMAND git -C "${SOURCE}" diff --quiet HEAD -- src shaders RESULT_VARIABLE changed
    ERROR_QUIET)
  if(changed)
    string(APPEND commit "-modified")
  endif()
endif()
# CONFIGURE writes only what differs, so that nothing is rebuilt in vain.
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "// Generated; do not edit.
#pragma once
#define BRUME_VERSION \"@VERSION@\"
#define BRUME_COMMIT \"@commit@\"
" @ONLY)
