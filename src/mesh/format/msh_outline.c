// Sections of MSH 2.2 and 4.1. Gmsh itself reads over counts that are too small, and takes memory for any that are too
// large; a file that does not begin as a mesh it would run as a script.
//
//   2.2  $Nodes N, a line a node $EndNodes       (binary: 28 bytes a node)         $Elements N, a line an element
//   4.1  $Nodes blocks N lowest highest, a line a block, two lines a node          (binary: four 8-byte numbers first)
//        $Elements blocks N lowest highest, a line a block, a line an element
#include "mesh/format/msh_outline.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"

typedef struct Format {
	const char* path;
	bool is_4, is_binary;
} Format;

/// Bytes of a section behind its opening line, up to its closing line.
typedef struct Section {
	const char *begin, *end;
} Section;

static JnStatus read_format(const char* path, const JnContent* content, Format* format) {
	double version = 0;
	int binary = 0, size = 0;
	if (content->size < 20 || memcmp(content->data, "$MeshFormat", 11) != 0)
		return jn_error(JN_BAD_INPUT, "%s: does not begin with $MeshFormat, as .msh files do", path);
	if (sscanf(content->data + 11, "%lf %d %d", &version, &binary, &size) != 3)
		return jn_error(JN_BAD_INPUT, "%s: has no version below $MeshFormat", path);
	const bool is_2 = version >= 2 && version<3, is_4 = version> 4.05 && version < 4.15;
	if (!is_2 && !is_4) return jn_error(JN_BAD_INPUT, "%s: is MSH %g; save it as version 2.2 or 4.1", path, version);
	if (size != 8 || (binary != 0 && binary != 1))
		return jn_error(JN_BAD_INPUT, "%s: has a file type %d or a number size %d that no .msh file has", path, binary,
						size);
	*format = (Format){path, is_4, binary == 1};
	return JN_OK;
}

static JnStatus find_section(const Format* format, const JnContent* content, const char* name, Section* section) {
	char opening[32], closing[32];
	snprintf(opening, sizeof opening, "\n$%s", name);
	snprintf(closing, sizeof closing, "$End%s", name);
	const char* end = content->data + content->size;
	const char* start = jn_content_find(content->data, end, opening);
	if (start == NULL) return jn_error(JN_BAD_INPUT, "%s: has no section $%s", format->path, name);
	const char* line = memchr(start + 1, '\n', (size_t)(end - start - 1));
	const char* stop = line != NULL ? jn_content_find(line, end, closing) : NULL;
	if (stop == NULL) return jn_error(JN_BAD_INPUT, "%s: has no %s: the file is cut off", format->path, closing);
	*section = (Section){line + 1, stop};
	return JN_OK;
}

static size_t count_lines(Section section) {
	size_t lines = 0;
	bool is_blank = true;
	for (const char* c = section.begin; c < section.end; ++c) {
		if (*c == '\n')
			is_blank = true;
		else if (*c != ' ' && *c != '\t' && *c != '\r') {
			lines += is_blank;
			is_blank = false;
		}
	}
	return lines;
}

/// Binary headers of version 4.1 hold 8-byte numbers; all others are text.
static bool read_counts(const Format* format, Section section, unsigned long long* blocks, unsigned long long* count) {
	uint64_t header[4];
	*blocks = 0;
	if (!format->is_4) return sscanf(section.begin, "%llu", count) == 1;
	if (!format->is_binary) return sscanf(section.begin, "%llu %llu", blocks, count) == 2;
	if (section.end - section.begin < (ptrdiff_t)sizeof header) return false;
	memcpy(header, section.begin, sizeof header);
	*blocks = header[0];
	*count = header[1];
	return true;
}

static JnStatus check_section(const Format* format, const JnContent* content, const char* name, size_t lines_each,
							  size_t* out) {
	Section section = {0};
	unsigned long long blocks = 0, count = 0;
	JN_TRY(find_section(format, content, name, &section));
	if (!read_counts(format, section, &blocks, &count))
		return jn_error(JN_BAD_INPUT, "%s: $%s does not begin with its counts", format->path, name);
	const size_t size = (size_t)(section.end - section.begin);
	if (count > size || blocks > size)
		return jn_error(JN_BAD_INPUT, "%s: $%s declares %llu entries in %llu blocks, more than its %zu bytes can hold",
						format->path, name, count, blocks, size);
	const size_t lines = format->is_binary ? 0 : count_lines(section);
	const size_t expected = 1 + (size_t)blocks + (size_t)count * (format->is_4 ? lines_each : 1);
	if (!format->is_binary && lines != expected)
		return jn_error(JN_BAD_INPUT, "%s: $%s has %zu lines where its counts ask for %zu", format->path, name, lines,
						expected);
	*out = (size_t)count;
	return JN_OK;
}

JnStatus jn_msh_outline(const char* path, const JnContent* content, JnMshOutline* outline) {
	Format format = {0};
	*outline = (JnMshOutline){0};
	JN_TRY(read_format(path, content, &format));
	outline->is_version_2 = !format.is_4;
	JN_TRY(check_section(&format, content, "Nodes", 2, &outline->nodes));
	return check_section(&format, content, "Elements", 1, &outline->elements);
}
