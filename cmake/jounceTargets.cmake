# libjounce and the command. Wide loops, src/force/solid_*.c and src/*/wide_*.c, are compiled once for each vector width into the
# same library, and the widest that the machine can run is chosen at run time.
file(GLOB JN_SOURCES CONFIGURE_DEPENDS src/*/*.c src/*/*/*.c)
file(GLOB JN_KERNEL_SOURCES CONFIGURE_DEPENDS src/force/solid_*.c src/*/wide_*.c)
list(FILTER JN_SOURCES EXCLUDE REGEX "/src/force/solid_[^/]*\\.c$|/src/[^/]*/wide_[^/]*\\.c$|/src/backend/")
# Loops over three coordinates, which -O2 does not unroll, are what these two folders are made of.
file(GLOB JN_LOOP_SOURCES CONFIGURE_DEPENDS src/detect/*.c src/pass/*.c)
set_source_files_properties(${JN_LOOP_SOURCES} PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release,RelWithDebInfo>:-O3>")
if(NOT JN_SOURCES)
	message(FATAL_ERROR "no sources under ${CMAKE_CURRENT_SOURCE_DIR}/src")
endif()

add_library(jounce ${JN_SOURCES})
add_library(jounce::jounce ALIAS jounce)
set_target_properties(jounce PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
target_include_directories(jounce
	PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
	PRIVATE src)

target_link_libraries(jounce PRIVATE $<BUILD_INTERFACE:jounce_flags> ${JN_DEPENDENCIES} OpenMP::OpenMP_C m
	${CMAKE_DL_LIBS})
if(CMAKE_BUILD_TYPE STREQUAL "Coverage")
	target_sources(jounce PRIVATE cmake/coverage_exit.c)
	target_link_options(jounce INTERFACE -Wl,--wrap=_exit,--wrap=__gcov_fork,--wrap=__gcov_execv,--wrap=__gcov_execvp)
endif()
if(JN_GMSH_LIBRARY)
	target_include_directories(jounce SYSTEM PRIVATE ${JN_GMSH_INCLUDE})
	target_compile_definitions(jounce PRIVATE JN_GMSH_LIBRARY="${JN_GMSH_LIBRARY}")
endif()

function(jounce_add_kernels width)
	if(NOT JN_KERNEL_SOURCES)
		return()
	endif()
	add_library(jounce_kernels_${width} OBJECT ${JN_KERNEL_SOURCES})
	target_include_directories(jounce_kernels_${width} PRIVATE include src)
	target_compile_definitions(jounce_kernels_${width} PRIVATE JN_WIDE=${width})
	# -Og does not inline through the pointers that these loops are given as constants
	target_compile_options(jounce_kernels_${width} PRIVATE ${ARGN} $<IF:$<CONFIG:Release,RelWithDebInfo>,-O3,-O1>)
	target_link_libraries(jounce_kernels_${width} PRIVATE jounce_flags OpenMP::OpenMP_C)
	if(JN_FUZZ) # they read no files; instrumented, these three builds take longer than all the rest
		set_target_properties(jounce_kernels_${width} PROPERTIES JN_PLAIN ON)
	endif()
	target_sources(jounce PRIVATE $<TARGET_OBJECTS:jounce_kernels_${width}>)
endfunction()

jounce_add_kernels(2)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
	jounce_add_kernels(4 -mavx2 -mfma)
	jounce_add_kernels(8 -mavx512f -mavx512dq -mavx512vl -mavx2 -mfma -mprefer-vector-width=512)
endif()

file(GLOB JN_COMMAND_SOURCES CONFIGURE_DEPENDS app/*.c app/*/*.c)
if(JN_COMMAND_SOURCES)
	# The command alone: `jounce view` serves by libmicrohttpd, `jounce export` writes glTF by jansson.
	jounce_find(microhttpd microhttpd.h libmicrohttpd-dev LIBRARIES microhttpd)
	jounce_find(jansson jansson.h libjansson-dev LIBRARIES jansson)
	add_executable(jounce_command ${JN_COMMAND_SOURCES})
	set_target_properties(jounce_command PROPERTIES OUTPUT_NAME jounce INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
	target_include_directories(jounce_command PRIVATE src app)

	target_link_libraries(jounce_command PRIVATE jounce jounce_flags ${JN_DEPENDENCIES} jounce::microhttpd
		jounce::jansson OpenMP::OpenMP_C m)
	include(jouncePage)
endif()
