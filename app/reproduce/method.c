#include "reproduce/method.h"

const Method method_list[METHODS] = {
	{"backward_euler", "BE", "#b2182b"},
	{"sdirk2", "SDIRK2", "#0072b2"},
	{"tr_bdf2", "TR-BDF2", "#56b4e9"},
	{"tr_bdf2_b", "TR-BDF2(B)", "#e69f00"},
	{"sdirk3", "SDIRK3", "#f0c808"},
	{"sdirk_ncs23", "SDIRK-NCS23", "#009e73"},
	{"sdirk_nc34", "SDIRK-NC34", "#66c2a4"},
	{"sdirk_3345", "SDIRK(3,3,4,5)", "#7b3294"},
	{"sdirk_4347", "SDIRK(4,3,4,7)", "#c2a5cf"},
	{"implicit_midpoint", "implicit midpoint", "#444444"},
	{"trapezoid", "trapezoid", "#999999"},
	{"esdirk324", "ESDIRK3(2)4", "#d6604d"},
	{"esdirk325", "ESDIRK3(2)5", "#8c510a"},
	{"esdirk436", "ESDIRK4(3)6", "#1b7837"},
};

void method_print_pen(JnTextFile* file, int method) {
	jn_text_print(file, "lw 1.8 lc rgb '%s'", method_list[method].colour);
}

void method_print_head(JnTextFile* file, const char* name, int width, int height) {
	jn_text_print(file,
				  "# To draw it again: gnuplot %s.gnuplot\n"
				  "set datafile separator ','\nset datafile missing 'nan'\nset logscale y\nset format y '10^{%%L}'\n"
				  "set grid lc rgb '#cccccc' lt 1 lw 0.5\nset key outside right noenhanced samplen 2\n"
				  "set border lc rgb '#444444'\nset encoding utf8\n"
				  "set terminal pngcairo size %d,%d font 'DejaVu Sans,11'\nset output '%s.png'\n",
				  name, width, height, name);
}
