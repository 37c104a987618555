#include "io/mesh_import.h"

#include "io/include.h"
#include "io/mesh.h"

#ifndef ASSIMP

bool mesh_available(void)
{
	return false;
}

int mesh_import(int fd, const char *name, const char *text, size_t n, const char *folders)
{
	(void)fd, (void)name, (void)text, (void)n, (void)folders;
	return 1;
}

#else

#include "geom/matrix.h"

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { BATCH = 256, NODES_DEEPEST = 4096 };
static const size_t companion_bytes_most = (size_t)1 << 30;

/* What is used of Assimp. It is loaded by the child that needs it: it allocates much, and takes time, before main is entered. */
struct assimp {
	struct aiPropertyStore *(*create_properties)(void);
	const struct aiScene *(*import)(const char *file, unsigned flags, struct aiFileIO *io, const struct aiPropertyStore *properties);
	const char *(*error)(void);
	enum aiReturn (*color)(const struct aiMaterial *m, const char *key, unsigned type, unsigned index, struct aiColor4D *out);
	enum aiReturn (*reals)(const struct aiMaterial *m, const char *key, unsigned type, unsigned index, ai_real *out, unsigned *most);
};

/* False, and the reason in dlerror, where the library of the build (ASSIMP) is not there or not itself. */
static bool load_assimp(struct assimp *a)
{
	void *library = dlopen(ASSIMP, RTLD_NOW | RTLD_LOCAL);
	return library && (*(void **)(void *)&a->create_properties = dlsym(library, "aiCreatePropertyStore")) &&
	       (*(void **)(void *)&a->import = dlsym(library, "aiImportFileExWithProperties")) &&
	       (*(void **)(void *)&a->error = dlsym(library, "aiGetErrorString")) &&
	       (*(void **)(void *)&a->color = dlsym(library, "aiGetMaterialColor")) &&
	       (*(void **)(void *)&a->reals = dlsym(library, "aiGetMaterialFloatArray"));
}

/* The files Assimp sees. */
struct files {
	const char *name, *folders, *text;
	size_t n;
};

/* One of them, open. */
struct open_file {
	const char *bytes;
	size_t size, at;
	struct text own; /* of a file that the first one names */
};

static size_t read_open(struct aiFile *file, char *out, size_t size, size_t count)
{
	struct open_file *f = (struct open_file *)(void *)file->UserData;
	size_t fits = size ? (f->size - f->at) / size : 0, n = count < fits ? count : fits;
	if (n > 0)
		memcpy(out, f->bytes + f->at, n * size);
	f->at += n * size;
	return n;
}

static size_t refuse_write(struct aiFile *file, const char *bytes, size_t size, size_t count)
{
	(void)file, (void)bytes, (void)size, (void)count;
	return 0;
}

static void flush_nothing(struct aiFile *file)
{
	(void)file;
}

static size_t tell_open(struct aiFile *file)
{
	return ((struct open_file *)(void *)file->UserData)->at;
}

static size_t size_open(struct aiFile *file)
{
	return ((struct open_file *)(void *)file->UserData)->size;
}

static enum aiReturn seek_open(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
	struct open_file *f = (struct open_file *)(void *)file->UserData;
	size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? f->at : f->size, at = base + offset;
	if (at > f->size)
		return aiReturn_FAILURE;
	f->at = at;
	return aiReturn_SUCCESS;
}

static void close_file(struct aiFileIO *io, struct aiFile *file)
{
	(void)io;
	struct open_file *f = (struct open_file *)(void *)file->UserData;
	text_free(&f->own);
	free(f);
	free(file);
}

static struct aiFile *open_file(struct aiFileIO *io, const char *path, const char *mode)
{
	const struct files *files = (const struct files *)(void *)io->UserData;
	if (strchr(mode, 'w') || strchr(mode, 'a') || strchr(mode, '+'))
		return NULL;
	struct open_file *f = calloc(1, sizeof *f);
	struct aiFile *file = calloc(1, sizeof *file);
	if (!f || !file)
		goto fail;
	if (strcmp(path, files->name) == 0) {
		f->bytes = files->text;
		f->size = files->n;
	} else {
		/* Assimp puts the scene's folder before names; include_read looks there anyway. */
		char found[4096];
		struct err e = { 0 };
		const char *slash = strrchr(files->name, '/');
		size_t folder = slash ? (size_t)(slash + 1 - files->name) : 0;
		const char *named = strncmp(path, files->name, folder) == 0 ? path + folder : path;
		while (named[0] == '.' && named[1] == '/')
			named += 2;
		if (include_read(files->name, 0, named, files->folders, companion_bytes_most, found, sizeof found, &f->own, &e) != 0)
			goto fail;
		f->bytes = f->own.bytes;
		f->size = f->own.size;
	}
	*file = (struct aiFile){ .ReadProc = read_open, .WriteProc = refuse_write, .TellProc = tell_open, .FileSizeProc = size_open,
		                 .SeekProc = seek_open, .FlushProc = flush_nothing, .UserData = (aiUserData)(void *)f };
	return file;
fail:
	if (f)
		text_free(&f->own);
	free(f);
	free(file);
	return NULL;
}

/* Triangles on their way into the pipe. */
struct sender {
	int fd;
	bool failed;
	const struct aiScene *scene;
	uint64_t count; /* of the triangles so far; only counted, not sent, where fd < 0 */
	struct mesh_triangle batch[BATCH];
	size_t waiting;
};

static bool send_all(int fd, const void *bytes, size_t n)
{
	const char *p = bytes;
	while (n > 0) {
		ssize_t done = write(fd, p, n);
		if (done < 0 && errno != EINTR)
			return false;
		p += done > 0 ? done : 0;
		n -= done > 0 ? (size_t)done : 0;
	}
	return true;
}

static void flush_batch(struct sender *s)
{
	if (s->fd >= 0 && !s->failed)
		s->failed = !send_all(s->fd, s->batch, s->waiting * sizeof *s->batch);
	s->waiting = 0;
}

static void send_triangle(struct sender *s, const struct aiMesh *mesh, const unsigned *k, const struct matrix *m, bool mirrored)
{
	s->count++;
	if (s->fd < 0)
		return;
	struct mesh_triangle *t = &s->batch[s->waiting++];
	*t = (struct mesh_triangle){ .material = mesh->mMaterialIndex };
	for (int i = 0; i < 3; i++) {
		unsigned at = k[mirrored ? 2 - i : i];
		const struct aiVector3D *p = &mesh->mVertices[at];
		struct vec q = matrix_point(vec((double)p->x, (double)p->y, (double)p->z), m);
		memcpy(t->corner[i], q.a, sizeof q.a);
		if (mesh->mNormals) {
			const struct aiVector3D *n = &mesh->mNormals[at];
			q = matrix_normal(vec((double)n->x, (double)n->y, (double)n->z), m);
			memcpy(t->normal[i], q.a, sizeof q.a);
		}
	}
	if (s->waiting == BATCH)
		flush_batch(s);
}

static void send_mesh(struct sender *s, const struct aiMesh *mesh, const struct matrix *m, bool mirrored)
{
	for (unsigned i = 0; i < mesh->mNumFaces; i++) {
		const struct aiFace *f = &mesh->mFaces[i];
		bool sound = f->mNumIndices == 3;
		for (unsigned k = 0; sound && k < 3; k++)
			sound = f->mIndices[k] < mesh->mNumVertices;
		if (sound)
			send_triangle(s, mesh, f->mIndices, m, mirrored);
	}
}

/* A node's meshes and those of the nodes below it. Assimp's matrices are for column vectors. */
static void send_node(struct sender *s, const struct aiNode *node, const struct matrix *above, int depth)
{
	const struct aiMatrix4x4 *t = &node->mTransformation;
	const struct matrix own = { { { (double)t->a1, (double)t->b1, (double)t->c1, 0 },
		                      { (double)t->a2, (double)t->b2, (double)t->c2, 0 },
		                      { (double)t->a3, (double)t->b3, (double)t->c3, 0 },
		                      { (double)t->a4, (double)t->b4, (double)t->c4, 1 } } };
	struct matrix m = matrix_multiply(&own, above);
	const struct vec x = vec(m.m[0][0], m.m[0][1], m.m[0][2]), y = vec(m.m[1][0], m.m[1][1], m.m[1][2]),
	                 z = vec(m.m[2][0], m.m[2][1], m.m[2][2]);
	bool mirrored = vec_dot(vec_cross(x, y), z) < 0;
	for (unsigned i = 0; i < node->mNumMeshes && !s->failed; i++)
		if (node->mMeshes[i] < s->scene->mNumMeshes)
			send_mesh(s, s->scene->mMeshes[node->mMeshes[i]], &m, mirrored);
	for (unsigned i = 0; i < node->mNumChildren && depth < NODES_DEEPEST && !s->failed; i++)
		send_node(s, node->mChildren[i], &m, depth + 1);
}

/* The decimal number that an author most likely wrote: 0.8, not 0.800000011920929. */
static double written(float x)
{
	char text[32];
	snprintf(text, sizeof text, "%.7g", (double)x);
	return strtod(text, NULL);
}

static double largest(const struct aiColor4D *c)
{
	return written(fmaxf(c->r, fmaxf(c->g, c->b)));
}

static void send_material(struct sender *s, const struct assimp *assimp, const struct aiMaterial *from)
{
	struct aiColor4D diffuse = { 0.8f, 0.8f, 0.8f, 1 }, specular = { 0, 0, 0, 1 };
	float shine = 0, opacity = 1, ior = 1;
	unsigned one = 1;
	if (assimp->color(from, AI_MATKEY_COLOR_DIFFUSE, &diffuse) != aiReturn_SUCCESS)
		assimp->color(from, AI_MATKEY_BASE_COLOR, &diffuse);
	assimp->color(from, AI_MATKEY_COLOR_SPECULAR, &specular);
	assimp->reals(from, AI_MATKEY_SHININESS, &shine, &one);
	assimp->reals(from, AI_MATKEY_OPACITY, &opacity, &one);
	assimp->reals(from, AI_MATKEY_REFRACTI, &ior, &one);
	const struct mesh_material m = { written(diffuse.r), written(diffuse.g), written(diffuse.b), largest(&specular), written(shine),
		                         written(1 - opacity), written(ior) };
	s->failed |= !send_all(s->fd, &m, sizeof m);
}

/* The whole scene, once to count its triangles, once to send them. */
static int send_scene(struct sender *s, const struct assimp *assimp, int fd)
{
	const struct matrix here = matrix_identity();
	struct mesh_head head = { .magic = MESH_MAGIC, .materials = s->scene->mNumMaterials };
	s->fd = -1;
	send_node(s, s->scene->mRootNode, &here, 0);
	head.triangles = s->count;
	s->fd = fd;
	s->failed = !send_all(fd, &head, sizeof head);
	for (unsigned i = 0; i < s->scene->mNumMaterials && !s->failed; i++)
		send_material(s, assimp, s->scene->mMaterials[i]);
	send_node(s, s->scene->mRootNode, &here, 0);
	flush_batch(s);
	return s->failed;
}

bool mesh_available(void)
{
	return true;
}

int mesh_import(int fd, const char *name, const char *text, size_t n, const char *folders)
{
	struct files files = { name, folders, text, n };
	struct aiFileIO io = { .OpenProc = open_file, .CloseProc = close_file, .UserData = (aiUserData)(void *)&files };
	struct mesh_head head = { .magic = MESH_MAGIC };
	struct assimp assimp;
	if (!load_assimp(&assimp)) {
		snprintf(head.message, sizeof head.message, "%s", dlerror());
		return !send_all(fd, &head, sizeof head);
	}
	const struct aiScene *scene = assimp.import(name, aiProcess_Triangulate, &io, assimp.create_properties());
	struct sender *s = calloc(1, sizeof *s);
	if (!s)
		return 1;
	if (scene && scene->mRootNode) {
		s->scene = scene;
		return send_scene(s, &assimp, fd);
	}
	const char *why = assimp.error();
	snprintf(head.message, sizeof head.message, "%s", *why ? why : "nothing in it");
	return !send_all(fd, &head, sizeof head);
}

#endif
