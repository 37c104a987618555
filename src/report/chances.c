#include "report/chances.h"

#include "base/rng.h"
#include "geom/interior.h"
#include "report/interiors.h"
#include "report/scatter.h"

#include <math.h>

enum { NODES = 600, SHAPES = 3, APPROXIMATIONS = 3, BINS = 66, CUTS = 12 };

static const struct {
	const char *name;
	double (*chance)(const struct box *scene, const struct box *node);
} approximations[APPROXIMATIONS] = {
	{ "eq. (2), SAH", interior_sah }, { "eq. (4), 26 centres", interior_hq26 }, { "eq. (5), fast", interior_fast6 },
};

/* Number i of the nodes: cuts of a cube, a hall and a corridor across random axes, up to CUTS of them. */
static struct box random_node(uint64_t i, struct box *scene)
{
	static const double sides[SHAPES][3] = { { 1, 1, 1 }, { 1, 1, 0.3 }, { 1, 0.3, 0.3 } };
	uint64_t key = rng_key(2009, 0, i), draw = 0;
	scene->lo = vec(0, 0, 0);
	scene->hi = vec(sides[i % SHAPES][0], sides[i % SHAPES][1], sides[i % SHAPES][2]);
	struct box node = *scene;
	for (int cuts = 1 + (int)(CUTS * rng_uniform(key, draw++)); cuts > 0; cuts--) {
		int axis = (int)(3 * rng_uniform(key, draw++));
		double at = node.lo.a[axis] + (0.1 + 0.8 * rng_uniform(key, draw++)) * (node.hi.a[axis] - node.lo.a[axis]);
		*(rng_uniform(key, draw++) < 0.5 ? &node.lo.a[axis] : &node.hi.a[axis]) = at;
	}
	return node;
}

bool chances_fill_scatter(struct plot *p, const struct table *t, const char *folder)
{
	(void)folder;
	struct scatter s = { .x_label = "exact chance that a ray meets the node", .y_label = "approximation / exact", .log_x = true };
	if (!interiors_hold(t))
		return false;
	for (int a = 0; a < APPROXIMATIONS; a++)
		for (uint64_t i = 0; i < NODES; i++) {
			struct box scene, node = random_node(i, &scene);
			double exact = interior_exact(&scene, &node);
			scatter_add(&s, approximations[a].name, exact, approximations[a].chance(&scene, &node) / exact);
		}
	bool any = scatter_finish(&s, p);
	scatter_free(&s);
	return any;
}

bool chances_fill_histogram(struct plot *p, const struct table *t, const char *folder)
{
	const double low = 0.2, high = 3.5, width = (high - low) / BINS;
	(void)folder;
	if (!interiors_hold(t))
		return false;
	text_print(&p->script, "set xlabel 'approximation / exact'\nset ylabel 'nodes'\nset key inside right top\nset grid linecolor '#dddddd'\n"
	           "set style fill transparent solid 0.35\nset arrow from 1, graph 0 to 1, graph 1 nohead linecolor '#888888' dashtype 2\nplot");
	for (int a = 0; a < APPROXIMATIONS; a++) {
		static const char *const colors[APPROXIMATIONS] = { "#0072B2", "#D55E00", "#009E73" };
		int count[BINS] = { 0 };
		for (uint64_t i = 0; i < NODES; i++) {
			struct box scene, node = random_node(i, &scene);
			double ratio = approximations[a].chance(&scene, &node) / interior_exact(&scene, &node);
			count[(int)fmin(BINS - 1, fmax(0, (ratio - low) / width))]++;
		}
		text_print(&p->script, "%s '%s.dat' index %d with fillsteps title '%s' linecolor '%s'", a ? "," : "", p->name, a,
		           approximations[a].name, colors[a]);
		for (int b = 0; b < BINS; b++)
			text_print(&p->data, "%.9g %d\n", low + b * width, count[b]);
		text_print(&p->data, "\n\n");
	}
	text_print(&p->script, "\n");
	return true;
}
