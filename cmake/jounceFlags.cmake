# Compiler flags of all targets, as the interface library jounce_flags. No -ffast-math and no contraction anywhere:
# results must not depend on the compiler's taste or on the width of the vectors.
set(CMAKE_C_STANDARD 17)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ${BUILD_SHARED_LIBS})
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_library(jounce_flags INTERFACE)
target_compile_options(jounce_flags INTERFACE
	-ffp-contract=off -fno-math-errno
	-Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes -Wmissing-prototypes
	-Wno-psabi # wide vectors as arguments: every caller is in the same build
	$<$<BOOL:${JN_WERROR}>:-Werror>)
if(JN_SANITIZE)
	target_compile_options(jounce_flags INTERFACE
		-fsanitize=${JN_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
	target_link_options(jounce_flags INTERFACE -fsanitize=${JN_SANITIZE})
endif()
