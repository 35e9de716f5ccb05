/// @file export.h
/// Meshes into files, by extension: volumes as .msh (Gmsh 4.1) or .vtu, surfaces as .obj, .ply, .stl or .off. Written
/// beside the path first and renamed, so that a file is whole or not there.
#ifndef JN_MESH_FORMAT_EXPORT_H
#define JN_MESH_FORMAT_EXPORT_H

#include "mesh/mesh.h"
#include "mesh/surface.h"

/// Node sets go along as physical groups of points (.msh) or as integer point data named "set:<name>" (.vtu).
JnStatus jn_export_volume(const JnMesh* mesh, const char* path);
JnStatus jn_export_surface(const JnSurface* surface, const char* path);

#endif
