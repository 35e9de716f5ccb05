#include "record/h5_journal.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#include <zlib.h>

#include "base/grow.h"
#include "base/log.h"

enum { PAGE = 4096 };

static const char magic[8] = "jounceJ1";
static const char suffix[] = ".journal";

// Head of a journal; the numbers of the pages and the pages follow.
typedef struct Head {
	char magic[8];
	uint64_t count;
	uint64_t sum; // of the numbers and the pages
} Head;

static void keep_error(JnH5Disk* disk) {
	if (disk->error == 0) disk->error = errno != 0 ? errno : EIO;
}

static bool write_all(int file, const void* data, size_t size, uint64_t address) {
	const char* at = data;
	while (size > 0) {
		const ssize_t count = pwrite(file, at, size, (off_t)address);
		if (count < 0 && errno == EINTR) continue;
		if (count <= 0) return false;
		at += count;
		address += (uint64_t)count;
		size -= (size_t)count;
	}
	return true;
}

// How much there was; less than `size` at the end of the file, or after a failure, which errno tells.
static size_t read_some(int file, void* out, size_t size, uint64_t address) {
	char* at = out;
	errno = 0;
	while (size > 0) {
		const ssize_t count = pread(file, at, size, (off_t)address);
		if (count < 0 && errno == EINTR) continue;
		if (count <= 0) break;
		at += count;
		address += (uint64_t)count;
		size -= (size_t)count;
	}
	return (size_t)(at - (char*)out);
}

// ---- pages

// Number of the first page that is not before `number`.
static int find_page(const JnH5Disk* disk, uint64_t number) {
	int low = 0, high = disk->page_count;
	while (low < high) {
		const int middle = low + (high - low) / 2;
		if (disk->pages[middle].number < number)
			low = middle + 1;
		else
			high = middle;
	}
	return low;
}

// The page, as the file has it when it is new here; NULL after a failure.
static unsigned char* touch_page(JnH5Disk* disk, uint64_t number) {
	const int at = find_page(disk, number);
	if (at < disk->page_count && disk->pages[at].number == number) return disk->pages[at].bytes;
	unsigned char* bytes = calloc(1, PAGE);
	const size_t count = (size_t)disk->page_count + 1;
	if (bytes == NULL || jn_grow((void**)&disk->pages, &disk->page_capacity, count, sizeof *disk->pages) != JN_OK) {
		free(bytes);
		errno = ENOMEM;
		keep_error(disk);
		return NULL;
	}
	memmove(disk->pages + at + 1, disk->pages + at, (size_t)(disk->page_count - at) * sizeof *disk->pages);
	disk->pages[at] = (JnH5Page){number, bytes};
	++disk->page_count;
	if (read_some(disk->file, bytes, PAGE, number * PAGE) < PAGE && errno != 0) keep_error(disk);
	return bytes;
}

static void drop_pages(JnH5Disk* disk) {
	for (int i = 0; i < disk->page_count; ++i) free(disk->pages[i].bytes);
	disk->page_count = 0;
}

void jn_h5_disk_read(JnH5Disk* disk, uint64_t address, size_t size, unsigned char* out) {
	const size_t found = read_some(disk->file, out, size, address);
	if (found < size && errno != 0) keep_error(disk);
	memset(out + found, 0, size - found);
	for (int i = find_page(disk, address / PAGE); i < disk->page_count; ++i) {
		const uint64_t begin = disk->pages[i].number * PAGE;
		if (begin >= address + size) break;
		const uint64_t from = begin > address ? begin : address;
		const uint64_t to = begin + PAGE < address + size ? begin + PAGE : address + size;
		memcpy(out + (from - address), disk->pages[i].bytes + (from - begin), (size_t)(to - from));
	}
}

void jn_h5_disk_write(JnH5Disk* disk, uint64_t address, size_t size, const unsigned char* data) {
	if (address + size > disk->end) disk->end = address + size;
	while (size > 0 && disk->error == 0 && address < disk->committed * PAGE) {
		const size_t within = (size_t)(address % PAGE), part = size < PAGE - within ? size : PAGE - within;
		unsigned char* page = touch_page(disk, address / PAGE);
		if (page == NULL) return;
		memcpy(page + within, data, part);
		address += part;
		data += part;
		size -= part;
	}
	if (size > 0 && disk->error == 0 && !write_all(disk->file, data, size, address)) keep_error(disk);
}

// ---- the journal

static bool apply(int file, uint64_t count, const uint64_t* numbers, const unsigned char* pages) {
	for (uint64_t i = 0; i < count; ++i)
		if (!write_all(file, pages + i * PAGE, PAGE, numbers[i] * PAGE)) return false;
	return true;
}

static uint64_t check_sum(const unsigned char* bytes, size_t size) {
	return crc32_z(0, bytes, size);
}

// The writer holds a lock on it for as long as it lives; readers that look for what a dead one has left hold it for moments.
// Whoever has removed it meanwhile, it is there again under its name.
static bool open_journal(JnH5Disk* disk) {
	static const struct timespec moment = {.tv_nsec = 10 * 1000 * 1000};
	for (int tries = 0; tries < 20; ++tries) {
		struct stat own, named;
		disk->journal = open(disk->journal_path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
		if (disk->journal < 0) return false;
		const bool is_locked = flock(disk->journal, LOCK_EX | LOCK_NB) == 0;
		const bool is_named = is_locked && fstat(disk->journal, &own) == 0 && stat(disk->journal_path, &named) == 0 &&
							  own.st_ino == named.st_ino;
		if (is_named) return ftruncate(disk->journal, 0) == 0;
		close(disk->journal);
		disk->journal = -1;
		errno = EWOULDBLOCK;
		nanosleep(&moment, NULL);
	}
	return false;
}

static bool write_journal(JnH5Disk* disk, unsigned char* content, size_t size) {
	Head head = {.count = (uint64_t)disk->page_count};
	memcpy(head.magic, magic, sizeof magic);
	uint64_t* numbers = (uint64_t*)(void*)(content + sizeof head);
	unsigned char* pages = (unsigned char*)(numbers + disk->page_count);
	for (int i = 0; i < disk->page_count; ++i) {
		numbers[i] = disk->pages[i].number;
		memcpy(pages + (size_t)i * PAGE, disk->pages[i].bytes, PAGE);
	}
	head.sum = check_sum(content + sizeof head, size - sizeof head);
	memcpy(content, &head, sizeof head);
	if (!write_all(disk->journal, content, size, 0)) return false;
	disk->is_applying = true;
	if (!apply(disk->file, head.count, numbers, pages) || ftruncate(disk->journal, 0) != 0) return false;
	disk->is_applying = false;
	return true;
}

static bool commit_pages(JnH5Disk* disk) {
	if (disk->page_count == 0) return true;
	const size_t size = sizeof(Head) + (size_t)disk->page_count * (sizeof(uint64_t) + PAGE);
	unsigned char* content = malloc(size);
	errno = ENOMEM;
	const bool is_good = content != NULL && write_journal(disk, content, size);
	free(content);
	return is_good;
}

// Make the file at least so long.
static bool reach(int file, uint64_t end) {
	struct stat facts;
	if (fstat(file, &facts) != 0) return false;
	return (uint64_t)facts.st_size >= end || ftruncate(file, (off_t)end) == 0;
}

void jn_h5_commit(JnH5Disk* disk) {
	if (disk->error != 0 || disk->is_rehearsal) return;
	bool is_good = !disk->is_cut || reach(disk->file, disk->end); // pages must not tell of an end that is not there
	if (is_good) is_good = commit_pages(disk);
	if (is_good && disk->is_cut) is_good = ftruncate(disk->file, (off_t)disk->end) == 0;
	if (!is_good) keep_error(disk);
	if (!is_good) return;
	disk->is_cut = false;
	disk->committed = (disk->end + PAGE - 1) / PAGE;
	drop_pages(disk);
}

void jn_h5_sync_disk(JnH5Disk* disk) {
	jn_h5_commit(disk);
	if (disk->error == 0 && !disk->is_rehearsal && fdatasync(disk->file) != 0) keep_error(disk);
}

static char* journal_path(const char* path) {
	const size_t size = strlen(path) + sizeof suffix;
	char* out = malloc(size);
	if (out != NULL) snprintf(out, size, "%s%s", path, suffix);
	return out;
}

static void close_files(JnH5Disk* disk) {
	if (disk->file >= 0 && close(disk->file) != 0) keep_error(disk);
	if (disk->journal >= 0 && !disk->is_applying) unlink(disk->journal_path);
	if (disk->journal >= 0) close(disk->journal);
	free(disk->journal_path);
	disk->journal_path = NULL;
	disk->file = disk->journal = -1;
}

bool jn_h5_disk_open(JnH5Disk* disk, const char* path, int flags) {
	struct stat facts;
	*disk = (JnH5Disk){.is_rehearsal = disk->is_rehearsal, .file = -1, .journal = -1};
	disk->journal_path = journal_path(path);
	errno = ENOMEM;
	const bool is_mine = disk->journal_path != NULL && ((flags & O_RDWR) == 0 || open_journal(disk));
	if (disk->is_rehearsal) flags = O_RDONLY;
	if (is_mine) disk->file = open(path, flags | O_CLOEXEC, 0666);
	if (disk->file >= 0 && fstat(disk->file, &facts) == 0) {
		disk->end = (uint64_t)facts.st_size;
		disk->committed = disk->is_rehearsal ? UINT64_MAX / PAGE : (disk->end + PAGE - 1) / PAGE;
		return true;
	}
	keep_error(disk);
	close_files(disk);
	return false;
}

void jn_h5_disk_close(JnH5Disk* disk) {
	jn_h5_commit(disk);
	close_files(disk);
	drop_pages(disk);
	free(disk->pages);
	disk->pages = NULL;
	disk->page_capacity = 0;
}

// ---- what a writer has left

// Whether it is whole. Only then has anything been written into the file.
static bool is_whole(const unsigned char* content, size_t size) {
	Head head;
	if (size < sizeof head) return false;
	memcpy(&head, content, sizeof head);
	if (memcmp(head.magic, magic, sizeof magic) != 0) return false;
	const size_t left = size - sizeof head, each = sizeof(uint64_t) + PAGE;
	return head.count <= left / each && left == head.count * each && head.sum == check_sum(content + sizeof head, left);
}

// A writer makes the file as long as its pages need before it writes the journal.
static bool are_inside(int file, uint64_t count, const uint64_t* numbers) {
	struct stat facts;
	if (fstat(file, &facts) != 0) return false;
	errno = EINVAL;
	for (uint64_t i = 0; i < count; ++i)
		if (numbers[i] >= ((uint64_t)facts.st_size + PAGE - 1) / PAGE) return false;
	return true;
}

static bool apply_journal(int journal, size_t size, const char* path) {
	unsigned char* content = malloc(size);
	bool is_good = content != NULL && read_some(journal, content, size, 0) == size;
	if (is_good && is_whole(content, size)) {
		const int file = open(path, O_RDWR | O_CLOEXEC);
		Head head;
		memcpy(&head, content, sizeof head);
		const uint64_t* numbers = (const uint64_t*)(const void*)(content + sizeof head);
		is_good = file >= 0 && are_inside(file, head.count, numbers) &&
				  apply(file, head.count, numbers, (const unsigned char*)(numbers + head.count)) &&
				  fdatasync(file) == 0;
		if (file >= 0) close(file);
	}
	free(content);
	return is_good;
}

static bool recover(int journal, const char* path, const char* name) {
	struct stat facts;
	if (flock(journal, LOCK_EX | LOCK_NB) != 0) return true; // its writer lives
	if (fstat(journal, &facts) != 0) return false;
	if (facts.st_size > 0 && !apply_journal(journal, (size_t)facts.st_size, path)) return false;
	return unlink(name) == 0;
}

JnStatus jn_h5_recover(const char* path) {
	char* name = journal_path(path);
	if (name == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: path of a journal");
	const int journal = open(name, O_RDWR | O_CLOEXEC);
	JnStatus status = JN_OK;
	if (journal >= 0 && !recover(journal, path, name))
		status = jn_error(JN_IO_FAILED, "%s: what a killed run has left here cannot be put into %s: %s", name, path,
						  strerror(errno));
	if (journal >= 0) close(journal);
	free(name);
	return status;
}
