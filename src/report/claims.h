/* What Aronov et al. 2002 said, beside what a job has measured. */
#ifndef REPORT_CLAIMS_H
#define REPORT_CLAIMS_H

#include "io/text.h"
#include "report/table.h"

/* One statement: where it stands, what the paper says, and how the same is measured; 'measure' prints nothing where the table has no
 * rows for it. */
struct claim {
	const char *place, *said;
	void (*measure)(struct text *out, const struct table *t);
};

/* NULL-placed at the end. */
extern const struct claim claims[];

#endif
