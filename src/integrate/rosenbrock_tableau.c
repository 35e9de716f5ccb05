/// @file rosenbrock_tableau.c
/// Coefficients of Rosenbrock methods in the transformed form, rounded to 22 digits from their exact form or from 40
/// digits, and their properties: order conditions of Hairer and Wanner II, IV.7, table 7.1; stability by tableau.c.
#include "integrate/rosenbrock_tableau.h"

#include <math.h>

enum { CONDITIONS = 8, MOST_SONS = 3, HIGHEST_ORDER = 4 };
static const double ORDER_TOLERANCE = 1e-13;

/// Trees with up to four nodes: the sons of the root, as earlier trees; -1 after the last.
static const struct {
	int nodes, density, sons[MOST_SONS];
} TREE[CONDITIONS] = {
	{1, 1, {-1}},                                                               // .
	{2, 2, {0, -1}},                                                            // [.]
	{3, 3, {0, 0, -1}}, {3, 6, {1, -1}},                                        // [. .], [[.]]
	{4, 4, {0, 0, 0}},  {4, 8, {0, 1, -1}}, {4, 12, {2, -1}}, {4, 24, {3, -1}}, // [. . .], [. [.]], ...
};

/// gamma_ij and alpha_ij from  Gamma (I / gamma - C) = I,  alpha = A Gamma,  b = m Gamma.
JnSlopeForm jn_rosenbrock_slopes(const JnRosenbrock* method) {
	JnSlopeForm out = {0};
	const int stages = method->stages;
	for (int j = 0; j < stages; j++) {
		out.gamma[j][j] = method->gamma;
		for (int i = j + 1; i < stages; i++) {
			long double sum = 0;
			for (int k = j; k < i; k++) sum += (long double)method->c[i][k] * out.gamma[k][j];
			out.gamma[i][j] = (double)(method->gamma * sum);
		}
	}
	for (int j = 0; j < stages; j++)
		for (int k = j; k < stages; k++) {
			for (int i = k + 1; i < stages; i++) out.alpha[i][j] += method->a[i][k] * out.gamma[k][j];
			out.b[j] += method->m[k] * out.gamma[k][j];
			out.b_embedded[j] += method->m_embedded[k] * out.gamma[k][j];
		}
	return out;
}

/// A vertex with one son multiplies by beta = alpha + gamma, one with several by alpha for each.
static void elementary_weights(const JnSlopeForm* form, const JnTableau* beta, double phi[CONDITIONS][JN_MAX_STAGES]) {
	for (int t = 0; t < CONDITIONS; t++)
		for (int i = 0; i < beta->stages; i++) {
			const bool is_alone = TREE[t].nodes > 1 && TREE[t].sons[1] < 0;
			const double* row = is_alone ? beta->a[i] : form->alpha[i];
			phi[t][i] = 1;
			for (int s = 0; s < MOST_SONS && TREE[t].sons[s] >= 0; s++) {
				double grafted = 0;
				for (int j = 0; j <= i; j++) grafted += row[j] * phi[TREE[t].sons[s]][j];
				phi[t][i] *= grafted;
			}
		}
}

static void find_order(const JnSlopeForm* form, const JnTableau* beta, JnTableauProperties* out) {
	double phi[CONDITIONS][JN_MAX_STAGES], residual[HIGHEST_ORDER + 1] = {0};
	elementary_weights(form, beta, phi);
	for (int t = 0; t < CONDITIONS; t++) {
		double sum = 0, bound = 0;
		for (int i = 0; i < beta->stages; i++) {
			sum += beta->b[i] * phi[t][i];
			bound += fabs(beta->b[i] * phi[t][i]);
		}
		const double violation = fabs(sum - 1.0 / TREE[t].density) / fmax(bound, 1);
		residual[TREE[t].nodes] = fmax(residual[TREE[t].nodes], violation);
	}
	out->order = 0;
	out->order_residual = 0;
	while (out->order < HIGHEST_ORDER && residual[out->order + 1] <= ORDER_TOLERANCE) {
		out->order++;
		out->order_residual = fmax(out->order_residual, residual[out->order]);
	}
}

/// On y' = z y the slopes are those of the Runge-Kutta method with A = alpha + gamma.
JnTableauProperties jn_rosenbrock_properties(const JnRosenbrock* method) {
	const JnSlopeForm form = jn_rosenbrock_slopes(method);
	JnTableau beta = {.stages = method->stages};
	for (int i = 0; i < method->stages; i++) {
		beta.b[i] = form.b[i];
		for (int j = 0; j <= i; j++) {
			beta.a[i][j] = form.alpha[i][j] + form.gamma[i][j];
			beta.c[i] += beta.a[i][j];
		}
	}
	JnTableauProperties out = jn_tableau_properties(&beta);
	find_order(&form, &beta, &out);
	out.stage_order = 1;
	if (method->has_embedded)
		out.error_order = 1 + (method->embedded_order < out.order ? method->embedded_order : out.order);
	if (fabs(method->alpha[method->stages - 1] - 1) > ORDER_TOLERANCE) out.stiffly_accurate = false;
	return out;
}

// clang-format off

// Linearised Backward Euler (Baraff and Witkin 1998): one stage, gamma = 1.
const JnRosenbrock jn_rosenbrock_linearized_euler = {
	.stages = 1,
	.gamma = 1,
	.m = {1},
	.alpha = {0},
	.gamma_sum = {1},
};

// Linearised implicit midpoint rule, the same as the linearised trapezoidal rule: one stage, gamma = 1/2.
const JnRosenbrock jn_rosenbrock_linearized_midpoint = {
	.stages = 1,
	.gamma = 0.5,
	.m = {2},
	.alpha = {0},
	.gamma_sum = {0.5},
};

// Verwer, Spee, Blom and Hundsdorfer 1999 with g = 1 - 1/sqrt(2): a21 = 1/g, c21 = -2/g, m = (3, 1)/(2g), embedded
// (1/g, 0).
const JnRosenbrock jn_rosenbrock_ros2 = {
	.stages = 2,
	.gamma = 0.2928932188134524755992,
	.a = {
		{                      0},
		{3.414213562373095048802},
	},
	.c = {
		{                       0},
		{-6.828427124746190097603},
	},
	.m = {5.121320343559642573203, 1.707106781186547524401},
	.alpha = {0, 1},
	.gamma_sum = {0.2928932188134524755992, -0.2928932188134524755992},
	.has_embedded = true,
	.m_embedded = {3.414213562373095048802, 0},
	.embedded_order = 1,
};

// Lang and Verwer 2001. g = 1/2 + sqrt(3)/6; in slope form alpha21 = alpha31 = 1, gamma21 = -1, gamma31 = -g,
// gamma32 = 1/2 - 2g, b = (2/3, 0, 1/3), embedded (1/3, 1/3, 1/3). Stages 2 and 3 share their force.
const JnRosenbrock jn_rosenbrock_ros3p = {
	.stages = 3,
	.gamma = 0.7886751345948128822546,
	.a = {
		{                      0},
		{1.267949192431122706473},
		{1.267949192431122706473, 0},
	},
	.c = {
		{                       0},
		{-1.607695154586736238835},
		{-3.464101615137754587055, -1.732050807568877293527},
	},
	.m = {2, 0.5773502691896257645091, 0.4226497308103742354909},
	.alpha = {0, 1, 1},
	.gamma_sum = {0.7886751345948128822546, -0.2113248654051871177454, -1.077350269189625764509},
	.has_embedded = true,
	.m_embedded = {2.113248654051871177454, 1, 0.4226497308103742354909},
	.embedded_order = 2,
};

// Lang and Teleaga 2008. g root of g^3 - 3g^2 + 3g/2 - 1/6; stiffly accurate. Its published 16 digits are refined by the
// conditions that it meets: order 3 and embedded order 2, b B^j (2 B^2 1 - alpha^2) = 0 with B = alpha + gamma, and
// embedded R(infinity) = -1/4. Stages 3 and 4 share their force.
const JnRosenbrock jn_rosenbrock_ros3pl = {
	.stages = 4,
	.gamma = 0.435866521508458999416,
	.a = {
		{                      0},
		{1.147140180139520859911},
		{2.463070773030053228635, 1.147140180139520859911},
		{2.463070773030053228635, 1.147140180139520859911, 0},
	},
	.c = {
		{                       0},
		{-2.631861185781064737447},
		{-1.302364158113095137295, 2.769432022251303544556},
		{-1.552568958732399974685, 2.587743501215152493523, -1.416993298352020140673},
	},
	.m = {2.463070773030053228635, 1.147140180139520859911, 0, 1},
	.alpha = {0, 0.5, 1, 1},
	.gamma_sum = {0.435866521508458999416, -0.06413347849154100058398, 0.1110281725125050346665, 0},
	.has_embedded = true,
	.m_embedded = {2.34694768351366530392, 0.4565305694518954250111, 0.05694924394549433041261, 0.7386849361662244645398},
	.embedded_order = 2,
};

// Rang 2015, g as above, 17 published digits projected onto the order conditions. Its second stage lies at t + 1.3076 h;
// sum b_i gamma_i = 0.0159, so that an inexact tangent leaves order 1. Stages 3 and 4 share their force.
const JnRosenbrock jn_rosenbrock_ros3prl2 = {
	.stages = 4,
	.gamma = 0.435866521508458999416,
	.a = {
		{                      0},
		{                      3},
		{4.588560720558083439644, 1.147140180139520859911},
		{4.588560720558083439644, 1.147140180139520859911, 0},
	},
	.c = {
		{                       0},
		{-6.882841080837125159466},
		{-12.57917970310449468022,  -2.947512718085716388283},
		{ 3.556592450580376724011, -0.4663124315128374671048, 3.545260255335102039126},
	},
	.m = {4.588560720558083439644, 1.147140180139520859911, 0, 1},
	.alpha = {0, 1.307599564525376998248, 1, 1},
	.gamma_sum = {0.435866521508458999416, -0.871733043016917998832, -0.8339865967040402891642, 0},
	.has_embedded = true,
	.m_embedded = {3.707697094267694651913, 0.8430234308281019988344, -0.1424847184289129595357, 0.7386849361662244645398},
	.embedded_order = 2,
};

// Rang and Angermann 2005, g as above; the published 17 digits, refined by the W-conditions of order 3.
const JnRosenbrock jn_rosenbrock_ros34pw2 = {
	.stages = 4,
	.gamma = 0.435866521508458999416,
	.a = {
		{                      0},
		{                      2},
		{1.419217317455764701894, -0.2592322116729697064838},
		{4.184760482319160492257, -0.2851920173554959003534, 2.294280360279041719822},
	},
	.c = {
		{                       0},
		{-4.588560720558083439644},
		{-4.184760482319160492257, 0.2851920173554959003534},
		{-6.368179200128356959134, -6.795620944466835744447, 2.87009860433105610659},
	},
	.m = {4.184760482319160492257, -0.2851920173554959003534, 2.294280360279041719822, 1},
	.alpha = {0, 0.871733043016917998832, 0.7315799577888523958636, 1},
	.gamma_sum = {0.435866521508458999416, -0.435866521508458999416, -0.4133333762338864431439, 0},
	.has_embedded = true,
	.m_embedded = {3.90701053467119173051, 1.118047877820503072404, 0.5216502326114906489016, 0.5},
	.embedded_order = 2,
};

// Rang and Angermann 2005. g = 1/2 + cos(pi/18)/sqrt(3); 17 published digits projected onto the conditions: order 4, and
// order 3 with any tangent. Not stiffly accurate.
const JnRosenbrock jn_rosenbrock_ros34pw3 = {
	.stages = 4,
	.gamma = 1.068579021301628806419,
	.a = {
		{                      0},
		{ 2.35410348876090865381},
		{2.127451851743233485163, 0.7018666706430658943928},
		{1.657354136690712576445, 0.3799836511912938607539, 0.7677537933767512324727},
	},
	.c = {
		{                       0},
		{-2.203022370674460064689},
		{-2.750060114993467380374, -0.8408569631081119265555},
		{-3.007787197315589553337, -0.7070774625618249978005, -1.187436274927435447696},
	},
	.m = {2.546875807690670124497, 0.5527809704437551510607, 0.9205219630499259765567, 0.7201674983256354590512},
	.alpha = {0, 2.51554560206288169786, 1.257772801031440853347, 0.6288864005157204223647},
	.gamma_sum = {1.068579021301628806419, -1.446966580761252891441, -0.7714762485313432614084, -0.2937117226108091514151},
	.has_embedded = true,
	.m_embedded = {2.340548705553893979123, 0.5501767383021500782172, 0.9137985681298547946345, 0},
	.embedded_order = 2,
};

// Sandu et al. 1997: rationals. Stages 1 and 2 share their force.
const JnRosenbrock jn_rosenbrock_rodas3 = {
	.stages = 4,
	.gamma = 0.5,
	.a = {
		{0},
		{0},
		{2, 0},
		{2, 0, 1},
	},
	.c = {
		{0},
		{4},
		{1, -1},
		{1, -1, -2.666666666666666666667},
	},
	.m = {2, 0, 1, 1},
	.alpha = {0, 0, 1, 1},
	.gamma_sum = {0.5, 1.5, 0, 0},
	.has_embedded = true,
	.m_embedded = {2, 0, 1, 0},
	.embedded_order = 2,
};

// Hairer and Wanner 1996, 16 published digits projected onto order 4, embedded order 3, stiff accuracy and the row sums
// alpha = (0, 0.386, 0.21, 0.63, 1, 1), gamma = (1/4, -0.1043, 0.1035, -0.0362, 0, 0).
const JnRosenbrock jn_rosenbrock_rodas4 = {
	.stages = 6,
	.gamma = 0.25,
	.a = {
		{                       0},
		{                   1.544},
		{0.9466785280815826670346, 0.2557011698983285403515},
		{ 3.314825187068519721895,  2.896124015972200832464, 0.9986419139977837328724},
		{ 1.221224509226639760999,  6.019134481288627448294,  12.53708332932087452587, -0.6878860361058947287295},
		{ 1.221224509226639760999,  6.019134481288627448294,  12.53708332932087452587, -0.6878860361058947287295, 1},
	},
	.c = {
		{                        0},
		{                  -5.6688},
		{ -2.430093356833874409961, -0.2063599157091908196574},
		{-0.1073529058151354704084,  -9.594562251023350221447, -20.47028614809615034295},
		{   7.49644331396765934143,  -10.24680431464351836362, -33.99990352819907125483, 11.70890893206160016043},
		{  8.083246795921539490445,  -7.981132988064886324364, -31.52159432874373735171, 16.31930543123137293758, -6.058818238834055030385},
	},
	.m = {1.221224509226639760999, 6.019134481288627448294, 12.53708332932087452587, -0.6878860361058947287295, 1, 1},
	.alpha = {0, 0.386, 0.21, 0.63, 1, 1},
	.gamma_sum = {0.25, -0.1043, 0.1035, -0.0362, 0, 0},
	.has_embedded = true,
	.m_embedded = {1.221224509226639760999, 6.019134481288627448294, 12.53708332932087452587, -0.6878860361058947287295, 1, 0},
	.embedded_order = 3,
};
