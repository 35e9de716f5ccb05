// series.csv: a header and one row a step. Numbers read back to the same bits; the file on disk ends with a whole row.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "base/timer.h"
#include "record/host.h"
#include "record/recorder.h"
#include "record/text_file.h"

enum { BUFFER_BYTES = 1 << 16, NUMBER_BYTES = 32 };

typedef struct Series {
	JnRecorder base;
	JnTextFile file;
	char* line;     // of a row: NUMBER_BYTES a column
	size_t pending; // bytes in the stream's buffer, at most BUFFER_BYTES
	long size;      // bytes of the file, those in the buffer included
	double flushed; // clock at the last flush [s]
} Series;

static JnStatus flush(Series* series) {
	series->pending = 0;
	series->flushed = jn_seconds();
	return jn_text_flush(&series->file);
}

static JnStatus take_line(Series* series, const JnRecordInfo* info) {
	series->line = malloc((size_t)info->column_count * NUMBER_BYTES + 1);
	return series->line != NULL ? JN_OK : jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for a row of series.csv");
}

static void abandon(Series* series) {
	jn_text_abandon(&series->file);
	free(series->line);
}

static JnStatus write_header(Series* series, const JnRecordInfo* info) {
	for (int i = 0; i < info->column_count; i++) {
		const char* name = info->columns[i].name;
		jn_text_print(&series->file, "%s%s", i > 0 ? "," : "", name);
		series->size += (long)strlen(name) + (i > 0);
	}
	jn_text_print(&series->file, "\n");
	++series->size;
	return flush(series);
}

static JnStatus open_series(JnRecorder* recorder, const JnRecordInfo* info) {
	Series* series = (Series*)recorder;
	JN_TRY(take_line(series, info));
	JnStatus status = jn_text_open(&series->file, info->directory, "series.csv", JN_TEXT_DIRECT);
	if (status == JN_OK) {
		setvbuf(series->file.stream, NULL, _IOFBF, BUFFER_BYTES);
		status = write_header(series, info);
	}
	if (status != JN_OK) abandon(series);
	return status;
}

static void archive_series(JnRecorder* recorder, JnArchive* archive) {
	jn_archive_long(archive, "series.csv", &((Series*)recorder)->size);
}

static JnStatus resume_series(JnRecorder* recorder, const JnRecordInfo* info, JnArchive* archive) {
	Series* series = (Series*)recorder;
	archive_series(recorder, archive);
	JN_TRY(archive->status);
	JN_TRY(take_line(series, info));
	const JnStatus status = jn_text_resume(&series->file, info->directory, "series.csv", series->size);
	series->flushed = jn_seconds();
	if (status == JN_OK)
		setvbuf(series->file.stream, NULL, _IOFBF, BUFFER_BYTES);
	else
		abandon(series);
	return status;
}

static JnStatus sync_series(JnRecorder* recorder) {
	Series* series = (Series*)recorder;
	JN_TRY(flush(series));
	return jn_text_sync(&series->file);
}

// 15 digits where they are enough, 17 where not: both read back to the same double.
static int print_number(char out[NUMBER_BYTES], double value, bool is_count) {
	if (is_count && fabs(value) < 0x1p53) return snprintf(out, NUMBER_BYTES, "%.0f", value);
	const int length = snprintf(out, NUMBER_BYTES, "%.15g", value);
	return strtod(out, NULL) == value ? length : snprintf(out, NUMBER_BYTES, "%.17g", value);
}

static JnStatus write_series(JnRecorder* recorder, const JnRecordStep* step) {
	Series* series = (Series*)recorder;
	const JnRecordInfo* info = recorder->info;
	size_t length = 0;
	if (step->values == NULL) return JN_OK;
	for (int i = 0; i < info->column_count; i++) {
		if (i > 0) series->line[length++] = ',';
		length += (size_t)print_number(series->line + length, step->values[i], info->columns[i].is_count);
	}
	series->line[length++] = '\n';
	if (series->pending + length > BUFFER_BYTES) JN_TRY(flush(series));
	jn_text_write(&series->file, series->line, length);
	series->pending += length;
	series->size += (long)length;
	return jn_seconds() - series->flushed >= 1 ? flush(series) : JN_OK;
}

static JnStatus close_series(JnRecorder* recorder, const JnRecordEnd* end) {
	Series* series = (Series*)recorder;
	(void)end;
	free(series->line);
	return jn_text_close(&series->file);
}

const JnRecorderType jn_recorder_series = {
	.name = "series",
	.doc = "series.csv: one row a step",
	.size = sizeof(Series),
	.open = open_series,
	.write = write_series,
	.close = close_series,
	.resume = resume_series,
	.archive = archive_series,
	.sync = sync_series,
};
