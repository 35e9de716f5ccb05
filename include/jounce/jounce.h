/// @file jounce.h
/// Everything public but extend.h, which those include who add methods, laws or systems of their own.
#ifndef JOUNCE_JOUNCE_H
#define JOUNCE_JOUNCE_H

#include "jounce/base.h"
#include "jounce/model.h"
#include "jounce/scene.h"
#include "jounce/sim.h"

#endif
