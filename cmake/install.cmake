# What is installed beside the Pd library (externals/install.cmake): the program and its manual
# (component tool), and what other programs are built with (component dev): headers, static
# libraries, and the files by which find_package(gait) finds them.
include(CMakePackageConfigHelpers)

if(TARGET gait)
  install(TARGETS gait RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tool)
  if(TARGET gait_manual)
    install(FILES ${PROJECT_BINARY_DIR}/tool/gait.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
            COMPONENT tool)
  endif()
endif()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/gait)
set_target_properties(gait_core PROPERTIES EXPORT_NAME core)
set(libraries gait_core)
set(header_folders core)
if(TARGET gait_osc)
  set_target_properties(gait_osc PROPERTIES EXPORT_NAME osc)
  list(APPEND libraries gait_osc)
  list(APPEND header_folders osc)
endif()
# A program for another instruction set than the library's would crash: it is refused
# (core/gait/alignment.h) by what the compiler that built the library says.
file(WRITE ${PROJECT_BINARY_DIR}/alignment.cpp
     "#include <Eigen/Core>\nGAIT_ALIGNS_BY EIGEN_MAX_ALIGN_BYTES\n")
get_target_property(eigen_include Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
separate_arguments(flags UNIX_COMMAND "${CMAKE_CXX_FLAGS}")
if(GAIT_NATIVE)
  list(APPEND flags -march=native)
endif()
execute_process(COMMAND ${CMAKE_CXX_COMPILER} ${flags} -std=c++20 -E -P -I${eigen_include}
                        ${PROJECT_BINARY_DIR}/alignment.cpp
                OUTPUT_VARIABLE preprocessed ERROR_QUIET)
if(preprocessed MATCHES "GAIT_ALIGNS_BY ([0-9]+)")
  target_compile_definitions(gait_core INTERFACE
                             $<INSTALL_INTERFACE:GAIT_EIGEN_ALIGNMENT=${CMAKE_MATCH_1}>)
endif()
install(TARGETS ${libraries} EXPORT gaitTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
foreach(folder ${header_folders})
  # What reads and writes a model's fields is the library's own affair.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder}/gait DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
          COMPONENT dev FILES_MATCHING PATTERN "*.h" PATTERN "posix" EXCLUDE
          PATTERN "cbor_document.h" EXCLUDE PATTERN "model_field.h" EXCLUDE
          PATTERN "model_fields.h" EXCLUDE)
endforeach()
install(EXPORT gaitTargets NAMESPACE gait:: DESTINATION ${package_dir} COMPONENT dev)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/gaitConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/gaitConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gaitConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/gaitConfig.cmake ${PROJECT_BINARY_DIR}/gaitConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT dev)
