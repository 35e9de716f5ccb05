# Limits of time are for a processor that others use too; sanitizers make a test some ten times as slow.
set(JN_TEST_SECONDS 300)
if(JN_SANITIZE)
	set(JN_TEST_SECONDS 1500)
endif()

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

# The calls of test/support/refused_calls.c.
set(refused_calls pwrite pread ftruncate fstat fopen fflush fwrite fread vfprintf fseek rename mkdir open close fclose fsync
	fdatasync waitpid posix_spawn_file_actions_init posix_spawn_file_actions_addopen posix_spawn_file_actions_adddup2
	posix_spawnp H5FDregister H5Pset_driver H5Pcreate H5Pset_create_intermediate_group H5Pset_libver_bounds
	H5Pget_mdc_config H5Pset_cache H5Pset_fclose_degree H5Fcreate H5Fopen H5Fflush H5Fclose H5Gcreate2 H5Gclose H5Screate
	H5Screate_simple H5Sselect_hyperslab H5Sget_simple_extent_dims H5Dcreate2 H5Dopen2 H5Dget_space H5Dset_extent H5Dwrite
	H5Dclose H5Oopen H5Aexists H5Aopen H5Acreate2 H5Awrite H5Aclose H5Ldelete)
list(TRANSFORM refused_calls PREPEND "-Wl,--wrap=" OUTPUT_VARIABLE JN_REFUSED_CALLS_WRAP)

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

	if(name MATCHES "_refused_call$")
		target_link_options(${name} PRIVATE ${JN_REFUSED_CALLS_WRAP})
	endif()

	add_test(NAME ${name} COMMAND ${name} WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/test)
	set_tests_properties(${name} PROPERTIES TIMEOUT ${JN_TEST_SECONDS} ENVIRONMENT "OMP_WAIT_POLICY=passive")
	if(name MATCHES "_refused_call$" AND JN_SANITIZE) # a process for each time that a run is gone on with
		set_tests_properties(${name} PROPERTIES TIMEOUT 1200)
	endif()
	if(name MATCHES "_long$")
		set_tests_properties(${name} PROPERTIES TIMEOUT 3600 LABELS long)
	endif()
endforeach()

# What each sanitizer is for, done on purpose: a build in which it is silent finds nothing in the other tests either.
function(jounce_add_sanitizer_test sanitizer name report)
	if("${JN_SANITIZE}" MATCHES "${sanitizer}")
		add_executable(sanitizer_${name} test/sanitizer/${name}.c)
		target_link_libraries(sanitizer_${name} PRIVATE jounce_flags OpenMP::OpenMP_C)
		add_test(NAME sanitizer_${name} COMMAND sanitizer_${name})
		set_tests_properties(sanitizer_${name} PROPERTIES PASS_REGULAR_EXPRESSION "${report}")
	endif()
endfunction()
jounce_add_sanitizer_test(thread race "data race")
jounce_add_sanitizer_test(address overrun "heap-buffer-overflow")
jounce_add_sanitizer_test(undefined overflow "signed integer overflow")

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

# What is built against an installed library has no sanitizer to link, nor gcov.
if(TARGET jounce_command AND NOT JN_SANITIZE AND NOT CMAKE_BUILD_TYPE STREQUAL "Coverage")
	add_test(NAME examples COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test/examples/build_and_run
		${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR} ${CMAKE_CURRENT_BINARY_DIR}/examples_test)
	set_tests_properties(examples PROPERTIES TIMEOUT ${JN_TEST_SECONDS})
endif()

# XDMF and VTU in the readers that users have: meshio's and VTK's.
if(JN_PYTHON AND TARGET jounce_command)
	add_test(NAME app_readers COMMAND ${JN_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/test/app/check_readers.py
		$<TARGET_FILE:jounce_command> ${CMAKE_CURRENT_BINARY_DIR}/readers_test)
	set_tests_properties(app_readers PROPERTIES TIMEOUT ${JN_TEST_SECONDS} SKIP_RETURN_CODE 77)
endif()

# Khronos' validator of glTF is a package of npm.
find_program(JN_NODE NAMES node nodejs)
find_program(JN_NPM NAMES npm)
mark_as_advanced(JN_NODE JN_NPM)
if(JN_NODE AND JN_NPM AND TARGET jounce_command)
	add_test(NAME app_gltf COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test/app/gltf/validate $<TARGET_FILE:jounce_command>
		${CMAKE_CURRENT_BINARY_DIR}/gltf_test)
	set_tests_properties(app_gltf PROPERTIES TIMEOUT ${JN_TEST_SECONDS} SKIP_RETURN_CODE 77)
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
	# What a run takes for its frames, and what it frees and takes again at each saved state: 0.05 s apart, as minutes have.
	set(soak ${JN_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/tools/soak --jounce $<TARGET_FILE:jounce_command> --set record.plots=no)
	add_test(NAME soak_frames_long COMMAND ${soak} ${CMAKE_CURRENT_SOURCE_DIR}/scenes/ball.yaml --set duration=100000
		--seconds 20 --settle 8)
	add_test(NAME soak_saved_long COMMAND ${soak} ${CMAKE_CURRENT_SOURCE_DIR}/scenes/shatter.yaml --set duration=1000
		--set checkpoint.every=0.05 --seconds 40 --settle 15)
	set_tests_properties(soak_frames_long soak_saved_long PROPERTIES TIMEOUT 3600 LABELS long)
	set_tests_properties(random_known random_scenes PROPERTIES TIMEOUT 1200 SKIP_RETURN_CODE 77)
	set_tests_properties(random_scenes_long PROPERTIES TIMEOUT 3600 SKIP_RETURN_CODE 77 LABELS long)
endif()

# Damaged copies of a recording, each read by a command.
if(JN_PYTHON AND TARGET jounce_command)
	set(damage_recordings ${JN_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/tools/damage_recordings
		--jounce $<TARGET_FILE:jounce_command>)
	add_test(NAME damaged_recordings COMMAND ${damage_recordings} --copies 120)
	add_test(NAME damaged_recordings_others
		COMMAND ${damage_recordings} --copies 12 --reader report,view,resume,compare)
	add_test(NAME damaged_recordings_long COMMAND ${damage_recordings} --copies 3000 --seed 2)
	add_test(NAME damaged_recordings_others_long
		COMMAND ${damage_recordings} --copies 500 --seed 2 --reader report,view,resume,compare)
	set_tests_properties(damaged_recordings damaged_recordings_others PROPERTIES TIMEOUT 1200)
	set_tests_properties(damaged_recordings_long damaged_recordings_others_long PROPERTIES TIMEOUT 7200 LABELS long)
endif()
