/// @file segment.h
/// Where two segments are nearest to each other.
#ifndef JN_DETECT_SEGMENT_H
#define JN_DETECT_SEGMENT_H

/// Nearest points p = a[0] + share[0] (a[1] - a[0]) and q = b[0] + share[1] (b[1] - b[0]), shares between 0 and 1; of
/// parallel segments, in the middle of where they lie side by side. Fills offset = p - q; returns its square length.
double jn_segments_nearest(double a[2][3], double b[2][3], double share[2], double offset[3]);

#endif
