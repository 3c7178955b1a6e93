# Writes OUT, the source of version(), where it changes: of the repository in SOURCE if there is one, else RELEASE.
# cmake -DSOURCE=... -DRELEASE=0.2.0 -DOUT=... -P version.cmake
set(version ${RELEASE})
find_program(git git)
if(git AND EXISTS ${SOURCE}/.git)  # not that of another project which this one lies in
  function(ask answer)
    execute_process(COMMAND ${git} ${ARGN} WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE said ERROR_QUIET
                    OUTPUT_STRIP_TRAILING_WHITESPACE)
    set(${answer} "${said}" PARENT_SCOPE)
  endfunction()
  # The tag of the release, if this commit descends from it; a clone without tags or history has the commit alone.
  ask(version describe --tags --match v${RELEASE} --abbrev=8 --dirty)
  if(NOT version)
    ask(version describe --always --exclude=* --abbrev=8 --dirty)
    if(version)
      set(version v${RELEASE}+g${version})
    else()
      set(version v${RELEASE})  # not readable, or without a commit
    endif()
  endif()
  string(SUBSTRING ${version} 1 -1 version)
endif()

set(text "#include \"gapscope/base/version.h\"\n\nconst char* gapscope::version() { return \"${version}\"; }\n")
set(before "")
if(EXISTS ${OUT})
  file(READ ${OUT} before)
endif()
if(NOT text STREQUAL before)
  file(WRITE ${OUT} "${text}")
endif()
