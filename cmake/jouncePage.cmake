# The viewer's page, web/, built by Vite into one file that goes into the command. Its packages are in web/node_modules,
# which `npm ci` fills and `./dev build` looks after; without them the command has no page and says so.
find_program(JN_NODE node)
mark_as_advanced(JN_NODE)
set(web ${CMAKE_CURRENT_SOURCE_DIR}/web)
set(vite ${web}/node_modules/vite/bin/vite.js)
if(NOT JN_NODE OR NOT EXISTS ${vite})
	message(STATUS "without the viewer's page: it needs Node and `npm ci` in web/ (Debian: apt-get install nodejs npm)")
	return()
endif()

file(GLOB_RECURSE page_sources CONFIGURE_DEPENDS ${web}/src/*)
set(page ${CMAKE_CURRENT_BINARY_DIR}/page/index.html)
add_custom_command(OUTPUT ${page}
	COMMAND ${JN_NODE} ${vite} build --logLevel warn --outDir ${CMAKE_CURRENT_BINARY_DIR}/page --emptyOutDir
	WORKING_DIRECTORY ${web}
	DEPENDS ${page_sources} ${web}/index.html ${web}/vite.config.js ${web}/package-lock.json
	COMMENT "Building the viewer's page" VERBATIM)
add_custom_target(jounce_page DEPENDS ${page})
add_dependencies(jounce_command jounce_page)
set_source_files_properties(app/view_page.c PROPERTIES COMPILE_DEFINITIONS JN_PAGE_FILE="${page}" OBJECT_DEPENDS ${page})
set(JN_HAS_PAGE ON)
