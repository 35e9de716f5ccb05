#include "view_page.h"

#ifdef JN_PAGE_FILE
__asm__(".section .rodata\n"
		"view_page_start:\n"
		".incbin \"" JN_PAGE_FILE "\"\n"
		"view_page_end:\n"
		".previous\n");
extern const char view_page_start[], view_page_end[];

const char* view_page(size_t* size) {
	*size = (size_t)(view_page_end - view_page_start);
	return view_page_start;
}
#else
const char* view_page(size_t* size) {
	*size = 0;
	return NULL;
}
#endif
