# Installs BUILD into a folder of its own through DESTDIR, as packagers do, and builds and runs a
# program against what stands there: cmake -DBUILD=... -DSOURCE=... -DCOMPILER=... -DFLAGS=...
# -P install_test.cmake
set(folder ${BUILD}/tests/install)
file(REMOVE_RECURSE ${folder})
set(ENV{DESTDIR} ${folder}/root)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix /opt/gait
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
unset(ENV{DESTDIR})

file(GLOB top RELATIVE ${folder}/root ${folder}/root/*)
if(NOT top STREQUAL "opt")
  message(FATAL_ERROR "expected everything below the prefix, found ${top}")
endif()
set(prefix ${folder}/root/opt/gait)
set(expected include/gait/model/model_file.h ${LIBDIR}/cmake/gait/gaitConfig.cmake)
foreach(program ${PROGRAMS})
  list(APPEND expected bin/${program} ${MANDIR}/man1/${program}.1)
endforeach()
if(PD_DIR)
  list(APPEND expected ${PD_DIR}/gait/gait.pd_linux ${PD_DIR}/gait/gait-demo.gait
       ${PD_DIR}/gait/help_patches/gait.pca-help.pd)
endif()
foreach(file ${expected})
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()

# The manual names every option of every subcommand, and roff has nothing to say against it.
foreach(program ${PROGRAMS})
  set(page ${prefix}/${MANDIR}/man1/${program}.1)
  find_program(GROFF groff)
  if(GROFF)
    execute_process(COMMAND ${GROFF} -ww -man -Tascii ${page} OUTPUT_QUIET
                    ERROR_VARIABLE complaints COMMAND_ERROR_IS_FATAL ANY)
    if(complaints)
      message(FATAL_ERROR "gait.1: ${complaints}")
    endif()
  endif()
  file(READ ${page} manual)
  string(REPLACE "\\-" "-" manual "${manual}")
  execute_process(COMMAND ${prefix}/bin/${program} --help OUTPUT_VARIABLE help
                  COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "Subcommands:\n.*\n\n" help "${help}")
  string(REGEX MATCHALL "\n  [a-z]+" subcommands "${help}")
  list(LENGTH subcommands count)
  if(count LESS 10)
    message(FATAL_ERROR "expected ten subcommands or more in --help, found ${count}")
  endif()
  foreach(subcommand ${subcommands})
    string(STRIP ${subcommand} subcommand)
    execute_process(COMMAND ${prefix}/bin/${program} ${subcommand} --help OUTPUT_VARIABLE help
                    COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCHALL "--[a-z][a-z-]*" options "${help}")
    foreach(word ".SS ${program} ${subcommand}\n" ${options})
      string(FIND "${manual}" "${word}" at)
      if(at LESS 0)
        message(FATAL_ERROR "gait.1 lacks '${word}' of ${program} ${subcommand} --help")
      endif()
    endforeach()
  endforeach()
endforeach()

execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE}/tests/install/consumer -B ${folder}/consumer
                        -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Debug
                        -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${folder}/consumer OUTPUT_QUIET
                COMMAND_ERROR_IS_FATAL ANY)
if(PD_DIR)
  execute_process(COMMAND ${folder}/consumer/consumer ${prefix}/${PD_DIR}/gait/gait-demo.gait
                  COMMAND_ERROR_IS_FATAL ANY)
endif()

execute_process(COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C ${CMAKE_COMMAND} --build ${folder}/consumer
                        --target wider OUTPUT_VARIABLE said ERROR_VARIABLE said
                RESULT_VARIABLE result)
if(X86 AND (result EQUAL 0 OR NOT said MATCHES "expected the instruction set that the library"))
  message(FATAL_ERROR "a program for AVX-512 is not refused: ${said}")
endif()
