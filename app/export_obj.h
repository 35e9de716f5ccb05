/// @file export_obj.h
/// Parts as OBJ, for all formats that come with such a file.
#ifndef JN_APP_EXPORT_OBJ_H
#define JN_APP_EXPORT_OBJ_H

#include "export.h"

/// Write a part whose first vertex has the number `first` in its file; numbers begin at 1.
void export_obj_part(JnTextFile* file, const ExportPart* part, const double* vertices, int first);

#endif
