/* A fuzz target without a fuzzer: every file of the folders given goes through it once. */
#include "tests/fuzz/fuzz.h"

#include <dirent.h>
#include <sys/stat.h>

static int replay_file(const char *path)
{
	FILE *f = fopen(path, "rb");
	struct stat info;
	size_t n = 0;
	if (!f || fstat(fileno(f), &info) != 0 || !S_ISREG(info.st_mode)) {
		if (f)
			fclose(f);
		return 0;
	}
	uint8_t *bytes = malloc((size_t)info.st_size + 1);
	if (bytes)
		n = fread(bytes, 1, (size_t)info.st_size, f);
	fclose(f);
	fprintf(stderr, "%s\n", path); /* the last one named is the one that crashed */
	if (bytes)
		LLVMFuzzerTestOneInput(bytes, n);
	free(bytes);
	return 1;
}

int main(int count, char **folders)
{
	int seen = 0;
	for (int i = 1; i < count; i++) {
		DIR *folder = opendir(folders[i]);
		for (struct dirent *entry; folder && (entry = readdir(folder)) != NULL;) {
			char path[4096];
			snprintf(path, sizeof path, "%s/%s", folders[i], entry->d_name);
			seen += replay_file(path);
		}
		if (folder)
			closedir(folder);
	}
	printf("%d files\n", seen);
	return seen > 0 ? 0 : 1;
}
