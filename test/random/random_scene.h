/// @file random_scene.h
/// Scenes drawn at random from the key tables that read scene files: every key and every row of every catalogue is in reach
/// because it is in its list.
#ifndef JN_TEST_RANDOM_RANDOM_SCENE_H
#define JN_TEST_RANDOM_RANDOM_SCENE_H

#include <stdint.h>
#include <stdio.h>

/// Write scene `index` of a seed as YAML. Of a scene that was refused, `attempt` 1, 2, ... are other draws with the same
/// method, law and controller.
void random_scene_write(uint64_t seed, long index, int attempt, FILE* out);

#endif
