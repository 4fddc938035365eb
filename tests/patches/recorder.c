/* Objects for tests only.
   [recorder FILE]: writes every message it gets as a line, numbers in full precision, so that tests
   can compare what a patch sends with what the core computes.
   [watch]: 1 begins to count what Pd's thread allocates, 0 ends it and posts `watch: N`. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <m_pd.h>
#include <stdio.h>

static t_class* recorder_class;

typedef struct {
  t_object object;
  FILE* file;
} t_recorder;

static void recorder_anything(t_recorder* x, t_symbol* selector, int count, t_atom* atoms) {
  fputs(selector->s_name, x->file);
  for (int i = 0; i < count; ++i)
    if (atoms[i].a_type == A_FLOAT)
      fprintf(x->file, " %.9g", (double)atoms[i].a_w.w_float);
    else if (atoms[i].a_type == A_SYMBOL)
      fprintf(x->file, " %s", atoms[i].a_w.w_symbol->s_name);
  fputc('\n', x->file);
  fflush(x->file);
}

static void* recorder_new(t_symbol* path) {
  t_recorder* x = (t_recorder*)pd_new(recorder_class);
  x->file = fopen(path->s_name, "w");
  if (!x->file) {
    pd_error(x, "recorder: cannot write %s", path->s_name);
    return NULL;
  }
  return x;
}

static void recorder_free(t_recorder* x) {
  if (x->file) fclose(x->file);
}

static t_class* watch_class;

static void watch_float(t_object* x, t_float on) {
  int (*watch)(int) = (int (*)(int))dlsym(RTLD_DEFAULT, "gait_watch");
  if (!watch) {
    pd_error(x, "watch: nobody counts here");
    return;
  }
  const int count = watch(on != 0);
  if (on == 0) post("watch: %d", count);
}

static void* watch_new(void) { return pd_new(watch_class); }

__attribute__((visibility("default"))) void recorder_setup(void);
void recorder_setup(void) {
  recorder_class = class_new(gensym("recorder"), (t_newmethod)recorder_new, (t_method)recorder_free,
                             sizeof(t_recorder), CLASS_DEFAULT, A_SYMBOL, A_NULL);
  class_addanything(recorder_class, (t_method)recorder_anything);
  watch_class = class_new(gensym("watch"), (t_newmethod)watch_new, 0, sizeof(t_object),
                          CLASS_DEFAULT, A_NULL);
  class_addfloat(watch_class, (t_method)watch_float);
}
