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
	string(REPLACE "," "$<COMMA>" sanitizers ${JN_SANITIZE})
	target_compile_options(jounce_flags INTERFACE # JN_PLAIN: a target without sanitizers
		$<$<NOT:$<BOOL:$<TARGET_PROPERTY:JN_PLAIN>>>:-fsanitize=${sanitizers}>
		-fno-sanitize-recover=all -fno-omit-frame-pointer)
	target_link_options(jounce_flags INTERFACE -fsanitize=${JN_SANITIZE})
endif()

# For tests: test/support/allocator.c stands between the code of jounce and malloc. The linker hands it what our objects
# alone ask for, not what shared libraries do; allocator_arena.c does the same for aligned memory and the pieces that arenas hand out.
set(JN_ALLOCATOR_WRAP "-Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc,--wrap=open_memstream")
set(JN_ARENA_WRAP "-Wl,--wrap=jn_aligned_take,--wrap=jn_arena_take,--wrap=jn_arena_text,--wrap=jn_grow")
