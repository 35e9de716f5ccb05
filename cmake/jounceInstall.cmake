# Headers, library, command, and the two ways to find them: pkg-config and find_package(jounce).
include(CMakePackageConfigHelpers)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/jounce)

install(DIRECTORY include/jounce DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(TARGETS jounce EXPORT jounceExport
	ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET jounce_command)
	install(TARGETS jounce_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(EXPORT jounceExport NAMESPACE jounce:: FILE jounceExport.cmake DESTINATION ${config_folder})

configure_package_config_file(cmake/jounceConfig.cmake.in jounceConfig.cmake INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(jounceConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/jounceConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/jounceConfigVersion.cmake
	cmake/jounceDependencies.cmake DESTINATION ${config_folder})

# A static library brings its dependencies to whoever links it, so they are in Libs; a shared one keeps them to itself.
set(libraries "")
foreach(dependency IN LISTS JN_DEPENDENCIES)
	get_target_property(paths ${dependency} INTERFACE_LINK_LIBRARIES)
	foreach(path IN LISTS paths)
		cmake_path(GET path PARENT_PATH folder)
		cmake_path(GET path STEM name)
		string(REGEX REPLACE "^lib" "-l" name ${name})
		if(NOT folder IN_LIST CMAKE_C_IMPLICIT_LINK_DIRECTORIES)
			set(name "-L${folder} ${name}")
		endif()
		string(APPEND libraries " ${name}")
	endforeach()
endforeach()
string(APPEND libraries " ${OpenMP_C_FLAGS} -lm")
set(JN_PC_LIBS "")
set(JN_PC_LIBS_PRIVATE "")
if(BUILD_SHARED_LIBS)
	set(JN_PC_LIBS_PRIVATE "${libraries}")
else()
	set(JN_PC_LIBS "${libraries}")
endif()
file(RELATIVE_PATH JN_PC_PREFIX "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}") # so that the folder may be moved
configure_file(jounce.pc.in jounce.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/jounce.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
