# Packs what is installed into ARCHIVE in the folder BUILD/deken, with OBJECTS beside it.
set(folder ${BUILD}/deken)
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --component pd --prefix ${folder}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -E tar cf ${ARCHIVE} --format=zip gait
                WORKING_DIRECTORY ${folder} COMMAND_ERROR_IS_FATAL ANY)
file(COPY_FILE ${OBJECTS} ${folder}/${ARCHIVE}.txt)
file(SHA256 ${folder}/${ARCHIVE} sum)
file(WRITE ${folder}/${ARCHIVE}.sha256 "${sum}  ${ARCHIVE}\n")
message(STATUS "${folder}/${ARCHIVE}")
