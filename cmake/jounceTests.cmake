# Every test/<folder>/<name>_test.c is one executable and one test, <folder>_<name>. Files called *_long_test.c carry the
# label `long`; `ctest -LE long`, `ctest --preset release` and `./dev test` leave them out.
jounce_find(cmocka cmocka.h libcmocka-dev LIBRARIES cmocka)
find_program(JN_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH) # Debian's own, for which python3-h5py is installed
find_program(JN_PYTHON NAMES python3)
mark_as_advanced(JN_PYTHON)

add_library(jounce_test INTERFACE) # what every test is compiled and linked with
target_include_directories(jounce_test INTERFACE include src test app)
target_compile_definitions(jounce_test INTERFACE JN_SOURCE_DIR="${CMAKE_CURRENT_SOURCE_DIR}"
	JN_PYTHON="$<IF:$<BOOL:${JN_PYTHON}>,${JN_PYTHON},python3>"
	$<$<TARGET_EXISTS:jounce_command>:JN_COMMAND="$<TARGET_FILE:jounce_command>">)
target_link_libraries(jounce_test INTERFACE jounce jounce_flags ${JN_DEPENDENCIES} jounce::cmocka OpenMP::OpenMP_C m)

file(GLOB support_sources CONFIGURE_DEPENDS test/support/*.c test/*/support.c)
if(support_sources)
	add_library(jounce_test_support STATIC ${support_sources})
	target_link_libraries(jounce_test_support PUBLIC jounce_test)
endif()

file(GLOB test_sources CONFIGURE_DEPENDS test/*/*_test.c)
foreach(source IN LISTS test_sources)
	cmake_path(GET source PARENT_PATH folder)
	cmake_path(GET folder FILENAME folder)
	cmake_path(GET source STEM name)
	string(REGEX REPLACE "_test$" "" name ${folder}_${name})

	add_executable(${name} ${source})
	set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/test)
	target_link_libraries(${name} PRIVATE $<TARGET_NAME_IF_EXISTS:jounce_test_support> jounce_test)
	if(TARGET jounce_command)
		add_dependencies(${name} jounce_command)
	endif()

	add_test(NAME ${name} COMMAND ${name} WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/test)
	set_tests_properties(${name} PROPERTIES TIMEOUT 300 ENVIRONMENT "OMP_WAIT_POLICY=passive")
	if(name MATCHES "_long$")
		set_tests_properties(${name} PROPERTIES TIMEOUT 3600 LABELS long)
	endif()
endforeach()

# Ipopt checks the contact solvers; its test is skipped where it is not installed.
find_path(JN_IPOPT_INCLUDE coin/IpStdCInterface.h)
find_library(JN_IPOPT_LIBRARY ipopt)
mark_as_advanced(JN_IPOPT_INCLUDE JN_IPOPT_LIBRARY)
if(JN_IPOPT_INCLUDE AND JN_IPOPT_LIBRARY AND TARGET solve_qp_ipopt)
	target_compile_definitions(solve_qp_ipopt PRIVATE JN_HAS_IPOPT)
	target_include_directories(solve_qp_ipopt SYSTEM PRIVATE ${JN_IPOPT_INCLUDE})
	target_link_libraries(solve_qp_ipopt PRIVATE ${JN_IPOPT_LIBRARY})
else()
	message(STATUS "without Ipopt: its test of contact solvers is skipped (Debian: apt-get install coinor-libipopt-dev)")
endif()

# What is built against an installed library has no sanitizer to link.
if(TARGET jounce_command AND NOT JN_SANITIZE)
	add_test(NAME examples COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test/examples/build_and_run
		${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR} ${CMAKE_CURRENT_BINARY_DIR}/examples_test)
	set_tests_properties(examples PROPERTIES TIMEOUT 300)
endif()
