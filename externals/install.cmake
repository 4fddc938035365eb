# Where the Pd library goes: one folder `gait` in GAIT_PD_DIR; and the archive that Pd's package finder
# (deken) takes.
install(TARGETS gait_pd LIBRARY DESTINATION ${GAIT_PD_DIR}/gait COMPONENT pd)
# ./demo does not build it: whoever has a Pd with 64-bit floats builds everything.
install(TARGETS gait_pd64 LIBRARY DESTINATION ${GAIT_PD_DIR}/gait COMPONENT pd OPTIONAL)
install(FILES ${GAIT_DEMO_MODEL} ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md
        DESTINATION ${GAIT_PD_DIR}/gait COMPONENT pd)
foreach(object ${GAIT_PD_OBJECTS})
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/../abstractions/gait.${object}.pd)
    continue()
  endif()
  install(FILES ${GAIT_PD_FOLDER}/gait.${object}.pd_linux DESTINATION ${GAIT_PD_DIR}/gait COMPONENT pd)
endforeach()
if(EXISTS ${PROJECT_SOURCE_DIR}/abstractions)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/abstractions/ DESTINATION ${GAIT_PD_DIR}/gait COMPONENT pd
          FILES_MATCHING PATTERN "*.pd")
  # Pd looks for an abstraction's help beside it and nowhere else.
  foreach(abstraction ${abstractions})
    get_filename_component(name ${abstraction} NAME)
    string(REGEX REPLACE "\\.pd$" "-help.pd" help ${name})
    install(FILES ${PROJECT_SOURCE_DIR}/help_patches/${help} DESTINATION ${GAIT_PD_DIR}/gait COMPONENT pd OPTIONAL)
  endforeach()
endif()
foreach(folder help_patches examples)
  if(EXISTS ${PROJECT_SOURCE_DIR}/${folder})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${GAIT_PD_DIR}/gait COMPONENT pd)
  endif()
endforeach()

if(NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
  return()
endif()
# deken: NAME[vVERSION](OS-MACHINE-FLOATSIZE)....dek, a zip with the folder in it; beside it the
# objects with their descriptions, and the sum (github.com/pure-data/deken).
set(GAIT_DEKEN "gait[v${PROJECT_VERSION}](Linux-${GAIT_PD_MACHINE}-32)(Linux-${GAIT_PD_MACHINE}-64).dek")
add_custom_target(deken
  COMMAND ${CMAKE_COMMAND} -DBUILD=${CMAKE_BINARY_DIR} -DARCHIVE=${GAIT_DEKEN}
          -DPD_DIR=${GAIT_PD_DIR} -DOBJECTS=${CMAKE_CURRENT_SOURCE_DIR}/objects.txt
          -P ${CMAKE_CURRENT_SOURCE_DIR}/deken.cmake
  DEPENDS gait_pd gait_pd64 gait_pd_folder
  COMMENT "Making ${GAIT_DEKEN}" VERBATIM)
