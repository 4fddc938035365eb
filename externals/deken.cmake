# Packs what is installed into PD_DIR as ARCHIVE in the folder BUILD/deken, with OBJECTS beside it.
set(folder ${BUILD}/deken)
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder})
# Below the archive's folder even where PD_DIR is absolute.
set(ENV{DESTDIR} ${folder}/installed)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --component pd --prefix /
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -E tar cf ${folder}/${ARCHIVE} --format=zip gait
                WORKING_DIRECTORY ${folder}/installed/${PD_DIR} COMMAND_ERROR_IS_FATAL ANY)
file(REMOVE_RECURSE ${folder}/installed)
file(COPY_FILE ${OBJECTS} ${folder}/${ARCHIVE}.txt)
file(SHA256 ${folder}/${ARCHIVE} sum)
file(WRITE ${folder}/${ARCHIVE}.sha256 "${sum}  ${ARCHIVE}\n")
message(STATUS "${folder}/${ARCHIVE}")
