/// @file compare_drawing.h
/// Pictures by gnuplot, from scripts that stay beside them.
#ifndef JN_APP_COMPARE_DRAWING_H
#define JN_APP_COMPARE_DRAWING_H

typedef enum CompareDrawing { COMPARE_DRAWN, COMPARE_NOT_DRAWN, COMPARE_NO_GNUPLOT } CompareDrawing;

/// Run name.gnuplot in `folder`. Pictures are a courtesy: what goes wrong is a warning, and gnuplot's words stay in
/// name.log.
CompareDrawing compare_draw(const char* folder, const char* name);

#endif
