# Fuzz targets: each test/fuzz/<target>.c is one. With JN_FUZZ (preset `fuzz`, clang) they are linked with libFuzzer, as
# build/fuzz/fuzz/<target>; with JN_TESTS each is a test, fuzz_<target>, that runs the inputs of test/fuzz/corpus/<target>.
file(GLOB fuzz_sources CONFIGURE_DEPENDS test/fuzz/*.c)
file(GLOB fuzz_support CONFIGURE_DEPENDS test/fuzz/support/*.c)
file(GLOB fuzz_commands CONFIGURE_DEPENDS test/fuzz/command/*.c)
list(FILTER fuzz_support EXCLUDE REGEX "/replay\\.c$")
set(app_sources ${JN_COMMAND_SOURCES})
list(FILTER app_sources EXCLUDE REGEX "/app/main\\.c$")

# The command's parts as a library, from which a target takes what it needs.
add_library(jounce_parts STATIC EXCLUDE_FROM_ALL ${app_sources})
target_include_directories(jounce_parts PUBLIC src app test)
target_link_libraries(jounce_parts PUBLIC jounce jounce_flags ${JN_DEPENDENCIES} jounce::microhttpd jounce::jansson
	OpenMP::OpenMP_C m)
set_target_properties(jounce_parts PROPERTIES EXPORT_COMPILE_COMMANDS OFF) # clang-tidy: once a file, as of the command
if(TARGET jounce_page)
	add_dependencies(jounce_parts jounce_page)
endif()
add_library(jounce_fuzz_support STATIC EXCLUDE_FROM_ALL ${fuzz_support} test/support/allocator.c)
target_include_directories(jounce_fuzz_support PUBLIC test/fuzz)
target_link_libraries(jounce_fuzz_support PUBLIC jounce_parts)

function(jounce_add_fuzz_target executable source)
	cmake_path(GET source STEM target)
	add_executable(${executable} ${source} ${ARGN})
	target_link_libraries(${executable} PRIVATE jounce_fuzz_support)
	target_link_options(${executable} PRIVATE ${JN_ALLOCATOR_WRAP})
	if(target STREQUAL "arguments")
		target_sources(${executable} PRIVATE ${fuzz_commands})
	endif()
endfunction()

if(JN_FUZZ)
	add_custom_target(fuzz)
	foreach(source IN LISTS fuzz_sources)
		cmake_path(GET source STEM target)
		jounce_add_fuzz_target(fuzz_${target} ${source})
		set_target_properties(fuzz_${target} PROPERTIES OUTPUT_NAME ${target} EXCLUDE_FROM_ALL ON
			RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/fuzz)
		target_link_options(fuzz_${target} PRIVATE -fsanitize=fuzzer)
		add_dependencies(fuzz fuzz_${target})
	endforeach()
endif()

if(JN_TESTS)
	foreach(source IN LISTS fuzz_sources)
		cmake_path(GET source STEM target)
		jounce_add_fuzz_target(replay_${target} ${source} test/fuzz/support/replay.c)
		set_target_properties(replay_${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/test)
		add_test(NAME fuzz_${target} COMMAND replay_${target} ${CMAKE_CURRENT_SOURCE_DIR}/test/fuzz/corpus/${target}
			WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/test)
		set_tests_properties(fuzz_${target} PROPERTIES TIMEOUT ${JN_TEST_SECONDS} ENVIRONMENT "OMP_WAIT_POLICY=passive")
	endforeach()
endif()
