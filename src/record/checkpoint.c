#include "record/checkpoint.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include "base/folder.h"
#include "base/log.h"

enum { VERSION = 1, ORDER = 0x01020304 };

static const char magic[8] = "jounceC";
static const char* const prefixes[JN_CHECKPOINT_KINDS] = {"step-", "end-"};
static const char suffix[] = ".jnc", folder_name[] = "checkpoints";

typedef struct Head {
	char magic[8];
	uint32_t version, order; // the latter tells the order of bytes
	uint64_t size;
	uint32_t sum, zero; // of the content
} Head;

// ---- names

static JnStatus folder_of(const char* directory, char path[JN_PATH_SIZE]) {
	return jn_path_join(directory, folder_name, path);
}

// The step that a file name tells; -1: it is another file.
static long step_of(JnCheckpointKind kind, const char* name) {
	const size_t length = strlen(prefixes[kind]);
	char* end;
	if (strncmp(name, prefixes[kind], length) != 0 || name[length] < '0' || name[length] > '9') return -1;
	errno = 0;
	const long step = strtol(name + length, &end, 10);
	return errno == 0 && strcmp(end, suffix) == 0 ? step : -1;
}

// Call `visit` for all files of a kind, in any order.
static void visit_files(const char* directory, JnCheckpointKind kind,
						void (*visit)(void* user, const JnCheckpointFile* file), void* user) {
	char folder[JN_PATH_SIZE];
	JnCheckpointFile file = {.kind = kind};
	if (folder_of(directory, folder) != JN_OK) return;
	DIR* stream = opendir(folder);
	for (struct dirent* entry; stream != NULL && (entry = readdir(stream)) != NULL;) {
		file.step = step_of(kind, entry->d_name);
		if (file.step >= 0 && jn_path_join(folder, entry->d_name, file.path) == JN_OK) visit(user, &file);
	}
	if (stream != NULL) closedir(stream);
}

typedef struct Search {
	long before;
	bool is_found;
	JnCheckpointFile* newest;
} Search;

static void take_newest(void* user, const JnCheckpointFile* file) {
	Search* search = user;
	if (file->step >= search->before || (search->is_found && file->step <= search->newest->step)) return;
	*search->newest = *file;
	search->is_found = true;
}

bool jn_checkpoint_find(const char* directory, JnCheckpointKind kind, long before, JnCheckpointFile* out) {
	Search search = {.before = before, .newest = out};
	visit_files(directory, kind, take_newest, &search);
	return search.is_found;
}

static void remove_old(void* user, const JnCheckpointFile* file) {
	if (file->step < *(const long*)user) unlink(file->path);
}

static void remove_before(const char* directory, JnCheckpointKind kind, long step) {
	visit_files(directory, kind, remove_old, &step);
}

void jn_checkpoints_remove(const char* directory) {
	char folder[JN_PATH_SIZE];
	for (int kind = 0; kind < JN_CHECKPOINT_KINDS; ++kind) remove_before(directory, (JnCheckpointKind)kind, LONG_MAX);
	if (folder_of(directory, folder) == JN_OK) rmdir(folder);
}

// ---- writing

static void sync_folder(const char* folder) {
	const int file = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
	if (file < 0) return;
	fsync(file);
	close(file);
}

JnStatus jn_checkpoint_write(const char* directory, JnCheckpointKind kind, long step, const void* bytes, size_t size,
							 int keep) {
	char folder[JN_PATH_SIZE], name[64];
	JnTextFile file;
	Head head = {.version = VERSION, .order = ORDER, .size = size, .sum = (uint32_t)crc32_z(0, bytes, size)};
	memcpy(head.magic, magic, sizeof magic);
	snprintf(name, sizeof name, "%s%010ld%s", prefixes[kind], step, suffix);
	JN_TRY(folder_of(directory, folder));
	JN_TRY(jn_folder_make(folder));
	JN_TRY(jn_text_open(&file, folder, name, JN_TEXT_REPLACE));
	jn_text_write(&file, (const char*)&head, sizeof head);
	jn_text_write(&file, bytes, size);
	JN_TRY(jn_text_close(&file));
	sync_folder(folder);
	JnCheckpointFile oldest = {.step = step};
	for (int i = 1; i < keep; ++i)
		if (!jn_checkpoint_find(directory, kind, oldest.step, &oldest)) return JN_OK;
	remove_before(directory, kind, oldest.step);
	return JN_OK;
}

// ---- reading

JnStatus jn_checkpoint_check(const char* path, const void* file, size_t file_size, const void** content, size_t* size) {
	Head head = {0};
	if (file_size >= sizeof head) memcpy(&head, file, sizeof head);
	if (file_size < sizeof head || memcmp(head.magic, magic, sizeof magic) != 0)
		return jn_error(JN_BAD_INPUT, "%s: is no checkpoint of jounce, or has lost its beginning", path);
	if (head.version != VERSION || head.order != ORDER)
		return jn_error(JN_BAD_INPUT,
						"%s: is a checkpoint of version %u%s, but this program reads version %d; resume it where it "
						"was written",
						path, head.version, head.order != ORDER ? " of another kind of processor" : "", VERSION);
	*content = (const char*)file + sizeof head;
	*size = file_size - sizeof head;
	if (head.size != *size)
		return jn_error(JN_BAD_INPUT, "%s: is damaged: it has %zu bytes of %llu", path, *size,
						(unsigned long long)head.size);
	if (head.sum != (uint32_t)crc32_z(0, *content, *size))
		return jn_error(JN_BAD_INPUT, "%s: is damaged: its check sum is wrong", path);
	return JN_OK;
}

static JnStatus read_file(const char* path, void** bytes, size_t* size) {
	struct stat facts;
	FILE* stream = fopen(path, "rb");
	if (stream == NULL || fstat(fileno(stream), &facts) != 0 || !S_ISREG(facts.st_mode)) {
		const char* why = stream == NULL ? strerror(errno) : "it is no file";
		if (stream != NULL) fclose(stream);
		return jn_error(JN_IO_FAILED, "%s: cannot read the checkpoint: %s", path, why);
	}
	*size = (size_t)facts.st_size;
	*bytes = malloc(*size + 1);
	const bool is_read = *bytes != NULL && fread(*bytes, 1, *size, stream) == *size;
	fclose(stream);
	if (is_read) return JN_OK;
	const bool is_short = *bytes == NULL;
	free(*bytes);
	if (is_short) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for %zu bytes of %s", *size, path);
	return jn_error(JN_IO_FAILED, "%s: cannot read the checkpoint", path);
}

JnStatus jn_checkpoint_read(const char* path, void** bytes, size_t* size) {
	const void* content = NULL;
	JN_TRY(read_file(path, bytes, size));
	const JnStatus status = jn_checkpoint_check(path, *bytes, *size, &content, size);
	if (status == JN_OK)
		memmove(*bytes, content, *size);
	else
		free(*bytes);
	return status;
}
