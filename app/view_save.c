// The page up to its </body>, the data, and the rest of the page.
#define _GNU_SOURCE // memmem
#include "view_save.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "view_code.h"
#include "view_field.h"
#include "view_page.h"

enum { SAMPLES = 5 };

typedef struct Saving {
	FILE* file;
	ViewRun* run;
	int index;      // of the run
	float* numbers; // of the drawn points
} Saving;

static JnStatus put(FILE* file, const char* name, const ViewBytes* coded) {
	fprintf(file, "<script type=\"text/plain\" id=\"%s\">", name);
	view_code_print(file, coded);
	fputs("</script>\n", file);
	return JN_OK;
}

// Deflate, write and free.
static JnStatus put_bytes(FILE* file, const char* name, ViewBytes bytes) {
	ViewBytes coded;
	JnStatus status = view_code_bytes(bytes.data, bytes.size, &coded);
	if (status == JN_OK) status = put(file, name, &coded);
	free(coded.data);
	free(bytes.data);
	return status;
}

// ---- frames ----

// The coded numbers of a frame: a field, or positions when `field` is NULL.
static JnStatus code_frame(const Saving* saving, const char* field, long frame, ViewBytes* coded) {
	ViewRun* run = saving->run;
	*coded = (ViewBytes){0};
	const JnStatus status = field == NULL ? view_run_positions(run, frame, saving->numbers)
										  : view_field_read(run, field, frame, saving->numbers);
	JN_TRY(status);
	return view_code_numbers(saving->numbers, run->points.count, field == NULL ? 3 : 1, coded);
}

// What a frame takes, with all its fields, in a page.
static JnStatus measure_frame(const Saving* saving, long frame, size_t* size) {
	*size = 0;
	for (int i = -1; i < saving->run->field_count; ++i) {
		ViewBytes coded;
		const JnStatus status = code_frame(saving, i < 0 ? NULL : saving->run->fields[i].name, frame, &coded);
		*size += coded.size / 3 * 4 + 80;
		free(coded.data);
		if (status != JN_OK && status != JN_BAD_INPUT) return status; // bad input: a field that is absent
	}
	return JN_OK;
}

// Every how many frames one is kept, so that the run takes no more than `limit` bytes.
static JnStatus choose_stride(const Saving* saving, size_t limit, long* stride) {
	const long count = saving->run->frame_count, samples = count < SAMPLES ? count : SAMPLES;
	size_t sum = 0;
	for (long i = 0; i < samples; ++i) {
		size_t size;
		JN_TRY(measure_frame(saving, i * (count - 1) / (samples > 1 ? samples - 1 : 1), &size));
		sum += size;
	}
	const double expected = samples > 0 ? (double)sum / (double)samples * (double)count : 0;
	*stride = 1 + (long)(expected / ((double)limit + 1));
	return JN_OK;
}

static JnStatus put_frame(const Saving* saving, const char* field, long frame, long number) {
	char name[160];
	ViewBytes coded;
	const JnStatus status = code_frame(saving, field, frame, &coded);
	if (field == NULL)
		snprintf(name, sizeof name, "%d/frames/%ld", saving->index, number);
	else
		snprintf(name, sizeof name, "%d/fields/%s/%ld", saving->index, field, number);
	if (status == JN_OK) put(saving->file, name, &coded);
	free(coded.data);
	return status;
}

// Frames 0, stride, 2 stride ...
static JnStatus put_frames(const Saving* saving, long stride) {
	for (long frame = 0, number = 0; frame < saving->run->frame_count; frame += stride, ++number)
		for (int i = -1; i < saving->run->field_count; ++i) {
			const JnStatus status = put_frame(saving, i < 0 ? NULL : saving->run->fields[i].name, frame, number);
			if (status != JN_OK && status != JN_BAD_INPUT) return status;
		}
	return JN_OK;
}

// ---- runs ----

// The run as it is with fewer frames.
static JnStatus put_facts(const Saving* saving, long stride) {
	char name[32];
	ViewBytes bytes;
	ViewRun fewer = *saving->run;
	double* times = malloc(((size_t)fewer.frame_count + 1) * sizeof *times);
	if (times == NULL) return JN_OUT_OF_MEMORY;
	fewer.frame_count = 0;
	for (long frame = 0; frame < saving->run->frame_count; frame += stride)
		times[fewer.frame_count++] = saving->run->times[frame];
	fewer.times = times;
	const JnStatus status = view_pack_run(&fewer, &bytes);
	free(times);
	JN_TRY(status);
	snprintf(name, sizeof name, "%d", saving->index);
	JN_TRY(put_bytes(saving->file, name, bytes));
	JN_TRY(view_pack_series(saving->run, &bytes));
	snprintf(name, sizeof name, "%d/series", saving->index);
	return put_bytes(saving->file, name, bytes);
}

static JnStatus put_run(Saving* saving, size_t limit, ViewSaved* saved) {
	long stride;
	JN_TRY(choose_stride(saving, limit, &stride));
	JN_TRY(put_facts(saving, stride)); // behind the sampling, which finds out which fields are absent
	JN_TRY(put_frames(saving, stride));
	const long count = saving->run->frame_count, kept = (count + stride - 1) / stride;
	if (saved->of_frames == 0 || (double)kept * (double)saved->of_frames < (double)saved->frames * (double)count) {
		saved->frames = kept;
		saved->of_frames = count;
	}
	return JN_OK;
}

static JnStatus put_runs(FILE* file, ViewSources* sources, size_t limit, ViewSaved* saved) {
	ViewAnswer answer = {0};
	view_answer(sources, "/api/runs", NULL, NULL, &answer);
	JN_TRY(put_bytes(file, "runs", (ViewBytes){answer.data, answer.size}));
	for (int i = 0; i < sources->count; ++i) {
		Saving saving = {.file = file, .run = &sources->list[i].run, .index = i};
		if (!sources->list[i].is_open) continue;
		saving.numbers = malloc((3 * (size_t)saving.run->points.count + 1) * sizeof *saving.numbers);
		const JnStatus status =
			saving.numbers != NULL ? put_run(&saving, limit / (size_t)sources->count, saved) : JN_OUT_OF_MEMORY;
		free(saving.numbers);
		if (status == JN_IO_FAILED)
			return jn_error(status, "%s: cannot be read to its end; run the scene again", saving.run->path);
		JN_TRY(status);
	}
	return JN_OK;
}

static JnStatus open_file(const char* path, JnTextFile* file) {
	char folder[JN_PATH_SIZE] = ".";
	const char* slash = strrchr(path, '/');
	if (slash != NULL) snprintf(folder, sizeof folder, "%.*s", slash > path ? (int)(slash - path) : 1, path);
	return jn_text_open(file, folder, slash != NULL ? slash + 1 : path, JN_TEXT_REPLACE);
}

JnStatus view_save(const char* path, ViewSources* sources, size_t limit, ViewSaved* saved) {
	JnTextFile file;
	size_t size;
	const char* page = view_page(&size);
	const char* end = memmem(page, size, "</body>", 7);
	*saved = (ViewSaved){0};
	if (end == NULL) return jn_error(JN_RUN_FAILED, "the viewer's page has no </body>");
	JN_TRY(open_file(path, &file));
	jn_text_write(&file, page, (size_t)(end - page));
	const JnStatus status = put_runs(file.stream, sources, limit > size ? limit - size : 1, saved);
	if (status != JN_OK) {
		jn_text_abandon(&file);
		return status;
	}
	jn_text_write(&file, end, size - (size_t)(end - page));
	saved->bytes = (size_t)ftello(file.stream);
	if (ferror(file.stream) && file.error == 0) file.error = EIO;
	return jn_text_close(&file);
}
