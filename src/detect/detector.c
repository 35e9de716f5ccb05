// A search: positions, boxes, then parts of the trees shared out to the threads, each with its own list. A vertex is
// handled by one thread alone, so that sorting the lists by vertex, stably, gives one order for any number of threads.
#include "detect/detector.h"

#include <math.h>
#include <stdlib.h>

#include "base/parallel.h"
#include "detect/search.h"

enum { PARTS = 64, GRAIN = 512 }; // of a tree; vertices that are worth another thread

struct JnDetector {
	JnArena arena;
	JnSearch search;
	JnMover* movers; // those of the search
	bool* self;
	double degradation;
	int threads;
	JnSearchMemory* memory; // one a thread
	JnSearchMemory sorted;  // its contacts alone: the result
	int* first_vertex;      // mover_count + 1: vertices of all skins, counted through
	int* place;             // one more than all vertices: where its contacts go
};

static JnStatus create_mover(const JnSkin* skin, const double* rest, JnArena* arena, JnMover* mover) {
	*mover = (JnMover){.skin = skin};
	JN_TRY(jn_adjacency_create(skin, arena, &mover->adjacency));
	JN_TRY(jn_skin_tree_create(skin, arena, &mover->tree));
	JN_NEW(arena, mover->motion.start, 3 * (size_t)skin->vertex_count);
	JN_NEW(arena, mover->motion.end, 3 * (size_t)skin->vertex_count);
	if (rest == NULL) return JN_OK;
	JN_NEW(arena, mover->rest, 3 * (size_t)skin->vertex_count);
	jn_skin_positions(skin, rest, mover->rest);
	return JN_OK;
}

static JnStatus fill(JnDetector* detector, const JnSkin* skins, const JnDetectorOptions* options) {
	const int count = detector->search.mover_count;
	JN_NEW(&detector->arena, detector->movers, count);
	JN_NEW(&detector->arena, detector->self, count);
	JN_NEW(&detector->arena, detector->memory, detector->threads);
	JN_NEW(&detector->arena, detector->first_vertex, (size_t)count + 1);
	for (int i = 0; i < count; i++) {
		detector->self[i] = options->self != NULL && options->self[i] && options->rest != NULL;
		JN_TRY(
			create_mover(&skins[i], detector->self[i] ? options->rest : NULL, &detector->arena, &detector->movers[i]));
		detector->first_vertex[i + 1] = detector->first_vertex[i] + skins[i].vertex_count;
	}
	JN_NEW(&detector->arena, detector->place, (size_t)detector->first_vertex[count] + 1);
	detector->search.movers = detector->movers;
	detector->search.self = detector->self;
	return JN_OK;
}

JnStatus jn_detector_create(int skin_count, const JnSkin* skins, int obstacle_count, const JnObstacle* obstacles,
							const JnDetectorOptions* options, JnDetector** out) {
	JnArena arena = {0};
	JnDetector* detector;
	*out = NULL;
	JN_NEW(&arena, detector, 1);
	detector->arena = arena;
	detector->search = (JnSearch){.mover_count = skin_count,
								  .obstacle_count = obstacle_count,
								  .obstacles = obstacles,
								  .neighborhood = options->neighborhood};
	detector->threads = options->threads > 1 ? options->threads : 1;
	detector->degradation = options->degradation > 0 ? options->degradation : 2;
	const JnStatus status = fill(detector, skins, options);
	if (status != JN_OK)
		jn_detector_destroy(detector);
	else
		*out = detector;
	return status;
}

void jn_detector_destroy(JnDetector* detector) {
	if (detector == NULL) return;
	for (int i = 0; i < detector->threads && detector->memory != NULL; i++) jn_search_memory_free(&detector->memory[i]);
	jn_search_memory_free(&detector->sorted);
	JnArena arena = detector->arena; // holds the detector itself
	jn_arena_free(&arena);
}

static bool all_finite(int count, const double* values) {
	double sum = 0;
	for (int i = 0; i < count; i++) sum += values[i] * 0; // NAN from NAN and from infinity
	return sum == 0;
}

/// Move the skins and fit their trees.
static JnStatus follow(JnDetector* detector, const double* x_start, const double* x_end, double margin,
					   JnContactCounts* counts) {
	for (int i = 0; i < detector->search.mover_count; i++) {
		JnMover* mover = &detector->movers[i];
		const int coordinates = 3 * mover->skin->vertex_count;
		jn_skin_positions(mover->skin, x_start, mover->motion.start);
		jn_skin_positions(mover->skin, x_end, mover->motion.end);
		mover->motion.margin = margin;
		if (!all_finite(coordinates, mover->motion.start) || !all_finite(coordinates, mover->motion.end))
			return JN_NOT_FINITE;
		counts->rebuilt += jn_skin_tree_follow(&mover->tree, &mover->motion, detector->degradation, detector->threads);
	}
	return JN_OK;
}

/// Part `part` of all, skin by skin.
static void search_one(const JnDetector* detector, int part, JnSearchMemory* memory) {
	const int mover = part / PARTS, number = part % PARTS;
	const int leaves = detector->movers[mover].tree.tree.leaf_count, parts = leaves < PARTS ? leaves : PARTS;
	if (number < parts) jn_search_part(&detector->search, mover, parts + number, memory);
}

static void search_all(JnDetector* detector) {
	const int parts = detector->search.mover_count * PARTS;
	const size_t vertices = (size_t)detector->first_vertex[detector->search.mover_count];
	const int team = jn_threads_for(vertices, GRAIN, detector->threads);
	for (int i = 0; i < detector->threads; i++) {
		detector->memory[i].contact_count = 0;
		detector->memory[i].counts = (JnContactCounts){0};
	}
#pragma omp parallel for schedule(dynamic, 1) num_threads(team) if (team > 1)
	for (int part = 0; part < parts; part++) search_one(detector, part, &detector->memory[jn_thread_number()]);
}

/// Where the contacts of each vertex begin in the sorted list.
static int count_places(const JnDetector* detector) {
	const int vertices = detector->first_vertex[detector->search.mover_count];
	int* place = detector->place;
	for (int i = 0; i <= vertices; i++) place[i] = 0;
	for (int t = 0; t < detector->threads; t++)
		for (int i = 0; i < detector->memory[t].contact_count; i++) {
			const JnContact* contact = &detector->memory[t].contacts[i];
			place[detector->first_vertex[contact->vertex_skin] + contact->vertex + 1]++;
		}
	for (int i = 0; i < vertices; i++) place[i + 1] += place[i];
	return place[vertices];
}

static JnStatus sort_contacts(JnDetector* detector) {
	JnSearchMemory* sorted = &detector->sorted;
	sorted->contact_count = count_places(detector);
	sorted->counts = (JnContactCounts){0};
	if (!jn_search_grow(sorted, (void**)&sorted->contacts, &sorted->contact_capacity, sorted->contact_count,
						sizeof *sorted->contacts))
		return sorted->status;
	for (int t = 0; t < detector->threads; t++)
		for (int i = 0; i < detector->memory[t].contact_count; i++) {
			const JnContact* contact = &detector->memory[t].contacts[i];
			const int vertex = detector->first_vertex[contact->vertex_skin] + contact->vertex;
			sorted->contacts[detector->place[vertex]++] = *contact;
		}
	return JN_OK;
}

static void sum_counts(const JnDetector* detector, JnContactCounts* counts) {
	const JnSearch* search = &detector->search;
	for (int i = 0; i < search->mover_count; i++)
		for (int k = 0; k < search->mover_count; k++)
			if (i != k || search->self[i])
				counts->pairs += (int64_t)search->movers[i].skin->vertex_count * search->movers[k].skin->triangle_count;
	for (int t = 0; t < detector->threads; t++) {
		counts->tested += detector->memory[t].counts.tested;
		counts->candidates += detector->memory[t].counts.candidates;
		counts->allocations += detector->memory[t].counts.allocations;
	}
	counts->allocations += detector->sorted.counts.allocations;
	counts->contacts = detector->sorted.contact_count;
}

JnStatus jn_detector_find(JnDetector* detector, const double* x_start, const double* x_end, double margin,
						  JnContactList* out) {
	*out = (JnContactList){0};
	detector->search.margin = margin;
	JN_TRY(follow(detector, x_start, x_end, margin, &out->counts));
	search_all(detector);
	for (int t = 0; t < detector->threads; t++) {
		const JnStatus status = detector->memory[t].status;
		detector->memory[t].status = JN_OK;
		JN_TRY(status);
	}
	JN_TRY(sort_contacts(detector));
	sum_counts(detector, &out->counts);
	out->count = detector->sorted.contact_count;
	out->contacts = detector->sorted.contacts;
	return JN_OK;
}
