/// @file page.h
/// The page of a study, written as index.html (with its own style and pictures beside it) and as page.md at once.
#ifndef JN_APP_REPRODUCE_PAGE_H
#define JN_APP_REPRODUCE_PAGE_H

#include "compare_jobs.h"
#include "record/text_file.h"
#include "reproduce/table.h"

typedef struct Page {
	JnTextFile html, markdown;
} Page;

/// Begin both files in `folder`. JN_IO_FAILED.
JnStatus page_open(Page* page, const char* folder, const char* name, const char* doc);
void page_heading(Page* page, const char* text);
/// A paragraph of plain text; it may take several lines.
void page_text(Page* page, const char* format, ...) __attribute__((format(printf, 2, 3)));
/// A picture that lies in the page's folder; left out when it was not drawn.
void page_picture(Page* page, const char* file, const char* caption);
/// A file beside the page, to be fetched.
void page_link(Page* page, const char* file, const char* words);
void page_table(Page* page, const Table* table);
/// What became of the runs, and the command for each.
void page_runs(Page* page, const ComparePlan* plan, const CompareJobs* jobs);
/// Add facts about the machine and give the files their names. JN_IO_FAILED.
JnStatus page_close(Page* page, const CompareOptions* options);

#endif
