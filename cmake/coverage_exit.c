// For the preset coverage alone, in place of _exit: files are read in children that leave by it, and what such a child
// counted would be lost.
void __gcov_dump(void);
void __real__exit(int status) __attribute__((noreturn));
void __wrap__exit(int status) __attribute__((noreturn));

void __wrap__exit(int status) {
	__gcov_dump();
	__real__exit(status);
}
