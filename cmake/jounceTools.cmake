# tools/*.c: programs that write documentation, built only when asked for (./dev docs).
file(GLOB tool_sources CONFIGURE_DEPENDS tools/*.c)
foreach(source IN LISTS tool_sources)
	cmake_path(GET source STEM name)
	add_executable(${name} EXCLUDE_FROM_ALL ${source})
	target_include_directories(${name} PRIVATE src test) # test: problems that a page and a sweep share
	target_link_libraries(${name} PRIVATE jounce jounce_flags ${JN_DEPENDENCIES} OpenMP::OpenMP_C m)
endforeach()
