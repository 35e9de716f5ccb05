// summary.json: what became of the run, in one object. Written once, at the end, whole or not at all.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "record/host.h"
#include "record/recorder.h"
#include "record/text_file.h"

typedef struct Summary {
	JnRecorder base;
	char created[32];
	double t_start; // of the first step [s]
	bool is_started;
} Summary;

// Bytes of the UTF-8 character at `text`, or 0 when there is none.
static int measure_character(const unsigned char* text) {
	const unsigned char lead = text[0];
	if (lead < 0x80) return 1;
	const int length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
	if (lead < 0xC2 || lead > 0xF4) return 0;
	for (int i = 1; i < length; i++) {
		if ((text[i] & 0xC0) != 0x80) return 0;
	}
	const bool is_overlong = (lead == 0xE0 && text[1] < 0xA0) || (lead == 0xF0 && text[1] < 0x90);
	const bool is_outside = (lead == 0xED && text[1] > 0x9F) || (lead == 0xF4 && text[1] > 0x8F);
	return is_overlong || is_outside ? 0 : length;
}

// A JSON string; bytes that are no UTF-8, as file names may hold, become U+FFFD.
static void print_text(JnTextFile* file, const char* text) {
	jn_text_print(file, "\"");
	for (const char* at = text; *at != '\0';) {
		const int length = measure_character((const unsigned char*)at);
		if (length == 0)
			jn_text_print(file, "\\ufffd");
		else if (*at == '"' || *at == '\\')
			jn_text_print(file, "\\%c", *at);
		else if ((unsigned char)*at < 0x20)
			jn_text_print(file, "\\u%04x", *at);
		else
			jn_text_write(file, at, (size_t)length);
		at += length > 0 ? length : 1;
	}
	jn_text_print(file, "\"");
}

// JSON has no word for infinity: null.
static void print_real(JnTextFile* file, double value) {
	char digits[32];
	snprintf(digits, sizeof digits, "%.15g", value);
	if (strtod(digits, NULL) != value) snprintf(digits, sizeof digits, "%.17g", value);
	jn_text_print(file, "%s", isfinite(value) ? digits : "null");
}

static void print_texts(JnTextFile* file, const Summary* summary, const JnRecordEnd* end) {
	const JnRecordInfo* info = summary->base.info;
	char finished[32];
	jn_host_time(finished);
	const char* const texts[][2] = {
		{"outcome", end->outcome},        {"message", end->message}, {"scene", info->scene_name},
		{"scene_path", info->scene_path}, {"method", info->method},  {"version", JN_VERSION},
		{"created", summary->created},    {"finished", finished},    {"blas", info->blas},
	};
	for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
		jn_text_print(file, "\t\"%s\": ", texts[i][0]);
		print_text(file, texts[i][1]);
		jn_text_print(file, ",\n");
	}
}

static void print_reals(JnTextFile* file, const Summary* summary, const JnRecordEnd* end) {
	const double simulated = end->t - summary->t_start;
	const struct {
		const char* name;
		double value;
	} reals[] = {
		{"t", end->t},
		{"t_end", end->t_end},
		{"setup_seconds", end->setup_seconds},
		{"wall_seconds", end->wall_seconds},
		{"wall_seconds_per_simulated_second", simulated > 0 ? end->wall_seconds / simulated : NAN},
		{"seconds_predict", end->seconds_predict},
		{"seconds_detect", end->seconds_detect},
		{"seconds_factor", end->seconds_factor},
		{"seconds_qp", end->seconds_qp},
		{"seconds_save", end->seconds_save},
		{"specific_error", end->specific_error},
		{"specific_error_max", end->specific_error_max},
		{"total_mass", summary->base.info->total_mass},
	};
	for (size_t i = 0; i < sizeof reals / sizeof reals[0]; i++) {
		jn_text_print(file, "\t\"%s\": ", reals[i].name);
		print_real(file, reals[i].value);
		jn_text_print(file, ",\n");
	}
}

static void print_counts(JnTextFile* file, const JnRecordInfo* info, const JnRecordEnd* end) {
	long cells = 0;
	for (int i = 0; i < info->body_count; i++) cells += info->bodies[i].cell_count;
	const struct {
		const char* name;
		long value;
	} counts[] = {
		{"nodes", info->node_count},     {"cells", cells},
		{"bodies", info->body_count},    {"steps", end->steps},
		{"frames", end->frames},         {"rejected", end->rejected},
		{"newton", end->newton},         {"factorizations", end->factorizations},
		{"solves", end->solves},         {"iterations", end->iterations},
		{"forces", end->forces},         {"tangents", end->tangents},
		{"indefinite", end->indefinite}, {"minimized", end->minimized},
		{"threads", info->threads},      {"simd_width", info->simd_width},
	};
	for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
		jn_text_print(file, "\t\"%s\": %ld,\n", counts[i].name, counts[i].value);
	}
}

// How linear systems were solved.
static void print_ways(JnTextFile* file, const JnRecordEnd* end) {
	jn_text_print(file, "\t\"solver\": {");
	for (int way = 0; way < JN_WAY_COUNT; way++)
		jn_text_print(file, "\"%s\": %ld, ", jn_way_name((JnWay)way), end->served[way]);
	jn_text_print(file, "\"changes\": %ld},\n", end->changes);
}

static void print_percentiles(JnTextFile* file, const char* name, const double values[JN_PACE_SHARES], double worst) {
	static const char* const shares[JN_PACE_SHARES] = {"p50", "p95", "p99", "p99_9"};
	jn_text_print(file, "\t\t\"%s\": {", name);
	for (int i = 0; i < JN_PACE_SHARES; i++) {
		jn_text_print(file, "\"%s\": ", shares[i]);
		print_real(file, values[i]);
		jn_text_print(file, ", ");
	}
	jn_text_print(file, "\"worst\": ");
	print_real(file, worst);
	jn_text_print(file, "},\n");
}

static void print_pace(JnTextFile* file, const JnPaceReport* pace) {
	const struct {
		const char* name;
		double value;
	} reals[] = {
		{"speed", pace->speed},
		{"missed_share", pace->steps > 0 ? (double)pace->missed / (double)pace->steps : 0},
		{"reached", pace->reached},
		{"possible", pace->possible},
		{"stepping_seconds", pace->stepping_seconds},
		{"waiting_seconds", pace->waiting_seconds},
		{"recording_seconds", pace->recording_seconds},
	};
	jn_text_print(file, "\t\"realtime\": {\n");
	for (size_t i = 0; i < sizeof reals / sizeof reals[0]; i++) {
		jn_text_print(file, "\t\t\"%s\": ", reals[i].name);
		print_real(file, reals[i].value);
		jn_text_print(file, ",\n");
	}
	print_percentiles(file, "step_seconds", pace->step, pace->step_worst);
	print_percentiles(file, "lateness_seconds", pace->lateness, pace->lateness_worst);
	print_percentiles(file, "waking_seconds", pace->waking, pace->waking_worst);
	jn_text_print(file, "\t\t\"steps\": %ld,\n\t\t\"missed\": %ld\n\t},\n", pace->steps, pace->missed);
}

static void print_host(JnTextFile* file) {
	const JnHost host = jn_host_describe();
	jn_text_print(file, "\t\"host\": {\n\t\t\"name\": ");
	print_text(file, host.name);
	jn_text_print(file, ",\n\t\t\"system\": ");
	print_text(file, host.system);
	jn_text_print(file, ",\n\t\t\"processor\": ");
	print_text(file, host.processor);
	jn_text_print(file, ",\n\t\t\"cores\": %d\n\t}\n", host.cores);
}

static JnStatus open_summary(JnRecorder* recorder, const JnRecordInfo* info) {
	(void)info;
	jn_host_time(((Summary*)recorder)->created);
	return JN_OK;
}

static JnStatus write_summary(JnRecorder* recorder, const JnRecordStep* step) {
	Summary* summary = (Summary*)recorder;
	if (!summary->is_started) summary->t_start = step->t;
	summary->is_started = true;
	return JN_OK;
}

static void archive_summary(JnRecorder* recorder, JnArchive* archive) {
	Summary* summary = (Summary*)recorder;
	jn_archive_bytes(archive, "created", summary->created, sizeof summary->created);
	summary->created[sizeof summary->created - 1] = '\0';
	jn_archive_real(archive, "t_start", &summary->t_start);
	jn_archive_switch(archive, "is_started", &summary->is_started);
}

static JnStatus resume_summary(JnRecorder* recorder, const JnRecordInfo* info, JnArchive* archive) {
	(void)info;
	archive_summary(recorder, archive);
	return archive->status;
}

static JnStatus close_summary(JnRecorder* recorder, const JnRecordEnd* end) {
	const Summary* summary = (const Summary*)recorder;
	JnTextFile file;
	JN_TRY(jn_text_open(&file, recorder->info->directory, "summary.json", JN_TEXT_REPLACE));
	jn_text_print(&file, "{\n");
	print_texts(&file, summary, end);
	print_reals(&file, summary, end);
	print_counts(&file, recorder->info, end);
	print_ways(&file, end);
	if (end->pace != NULL) print_pace(&file, end->pace);
	print_host(&file);
	jn_text_print(&file, "}\n");
	return jn_text_close(&file);
}

const JnRecorderType jn_recorder_summary = {
	.name = "summary",
	.doc = "summary.json: outcome, cost and accuracy of the run",
	.size = sizeof(Summary),
	.open = open_summary,
	.write = write_summary,
	.close = close_summary,
	.resume = resume_summary,
	.archive = archive_summary,
};
