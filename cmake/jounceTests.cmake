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
	if(folder STREQUAL "allocation")
		target_sources(${name} PRIVATE test/support/allocator.c test/support/allocator_arena.c)
		target_link_options(${name} PRIVATE ${JN_ALLOCATOR_WRAP} ${JN_ARENA_WRAP})
	endif()

	add_test(NAME ${name} COMMAND ${name} WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/test)
	set_tests_properties(${name} PROPERTIES TIMEOUT 300 ENVIRONMENT "OMP_WAIT_POLICY=passive")
	if(name MATCHES "_long$")
		set_tests_properties(${name} PROPERTIES TIMEOUT 3600 LABELS long)
	endif()
endforeach()

# The command's readers of recordings, and recordings to damage.
if(TARGET app_recording)
	target_link_libraries(app_recording PRIVATE jounce_fuzz_support)
endif()

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

# Without the viewer's page there is nothing to serve.
if(TARGET app_view)
	set_tests_properties(app_view PROPERTIES SKIP_RETURN_CODE 77)
	if(JN_HAS_PAGE)
		target_compile_definitions(app_view PRIVATE JN_HAS_PAGE)
	endif()
endif()

# The page in headless Chromium: what web/test says of it.
find_program(JN_CHROMIUM NAMES chromium chromium-browser google-chrome)
mark_as_advanced(JN_CHROMIUM)
if(JN_HAS_PAGE AND JN_CHROMIUM AND NOT JN_SANITIZE)
	set(playwright ${CMAKE_CURRENT_SOURCE_DIR}/web/node_modules/@playwright/test/cli.js)
	add_test(NAME page COMMAND ${JN_NODE} ${playwright} test WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/web)
	set_tests_properties(page PROPERTIES TIMEOUT 600 ENVIRONMENT
		"JOUNCE=$<TARGET_FILE:jounce_command>;CHROMIUM=${JN_CHROMIUM};JOUNCE_TEST_OUT=${CMAKE_CURRENT_BINARY_DIR}/page_test")
else()
	message(STATUS "without the tests of the viewer's page: they need the page and Chromium (Debian: apt-get install chromium)")
endif()

# What is built against an installed library has no sanitizer to link.
if(TARGET jounce_command AND NOT JN_SANITIZE)
	add_test(NAME examples COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test/examples/build_and_run
		${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR} ${CMAKE_CURRENT_BINARY_DIR}/examples_test)
	set_tests_properties(examples PROPERTIES TIMEOUT 300)
endif()

# XDMF and VTU in the readers that users have: meshio's and VTK's.
if(JN_PYTHON AND TARGET jounce_command)
	add_test(NAME app_readers COMMAND ${JN_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/test/app/check_readers.py
		$<TARGET_FILE:jounce_command> ${CMAKE_CURRENT_BINARY_DIR}/readers_test)
	set_tests_properties(app_readers PROPERTIES TIMEOUT 300 SKIP_RETURN_CODE 77)
endif()

# Khronos' validator of glTF is a package of npm.
find_program(JN_NODE NAMES node nodejs)
find_program(JN_NPM NAMES npm)
mark_as_advanced(JN_NODE JN_NPM)
if(JN_NODE AND JN_NPM AND TARGET jounce_command)
	add_test(NAME app_gltf COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test/app/gltf/validate $<TARGET_FILE:jounce_command>
		${CMAKE_CURRENT_BINARY_DIR}/gltf_test)
	set_tests_properties(app_gltf PROPERTIES TIMEOUT 300 SKIP_RETURN_CODE 77)
else()
	message(STATUS "without node and npm: glTF files are not validated (Debian: apt-get install nodejs npm)")
endif()

# Scenes drawn at random from the key tables, each run in a process of its own; and scenes that were defects once.
if(TARGET jounce_command)
	file(GLOB random_sources CONFIGURE_DEPENDS test/random/*.c)
	add_executable(random_scene ${random_sources})
	set_target_properties(random_scene PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/test)
	target_link_libraries(random_scene PRIVATE jounce_test)
	if(JN_SANITIZE) # shadow memory takes terabytes of addresses
		set(random_limits --memory 0 --cpu 60)
	endif()
	set(run_random_scenes ${JN_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/test/random/run_random_scenes
		--build ${CMAKE_CURRENT_BINARY_DIR} ${random_limits})
	file(GLOB known_scenes CONFIGURE_DEPENDS test/random/scenes/*.yaml)
	add_test(NAME random_known COMMAND ${run_random_scenes} ${known_scenes})
	add_test(NAME random_scenes COMMAND ${run_random_scenes} --count 60 --out ${CMAKE_CURRENT_BINARY_DIR}/random)
	add_test(NAME random_scenes_long COMMAND ${run_random_scenes} --first 1000 --count 1000
		--out ${CMAKE_CURRENT_BINARY_DIR}/random_long)
	add_test(NAME soak_long COMMAND ${JN_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/tools/soak
		${CMAKE_CURRENT_SOURCE_DIR}/scenes/ball.yaml --jounce $<TARGET_FILE:jounce_command> --set duration=100000
		--set record.plots=no --seconds 20 --settle 8)
	set_tests_properties(soak_long PROPERTIES TIMEOUT 3600 LABELS long)
	set_tests_properties(random_known random_scenes PROPERTIES TIMEOUT 1200 SKIP_RETURN_CODE 77)
	set_tests_properties(random_scenes_long PROPERTIES TIMEOUT 3600 SKIP_RETURN_CODE 77 LABELS long)
endif()
