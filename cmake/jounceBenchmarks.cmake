# benchmark/*.c are one program, jounce_bench; `./dev bench` runs it.
file(GLOB benchmark_sources CONFIGURE_DEPENDS benchmark/*.c)
if(benchmark_sources)
	add_executable(jounce_bench ${benchmark_sources})
	target_include_directories(jounce_bench PRIVATE include src benchmark)
	target_compile_definitions(jounce_bench PRIVATE JN_SOURCE_DIR="${CMAKE_CURRENT_SOURCE_DIR}")
	target_link_libraries(jounce_bench PRIVATE jounce jounce_flags ${JN_DEPENDENCIES} OpenMP::OpenMP_C m)
endif()
