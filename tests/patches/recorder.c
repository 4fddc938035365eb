/* [recorder FILE]: writes every message it gets as a line, numbers in full precision, so that tests
   can compare what a patch sends with what the core computes. Only for tests. */
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

__attribute__((visibility("default"))) void recorder_setup(void);
void recorder_setup(void) {
  recorder_class = class_new(gensym("recorder"), (t_newmethod)recorder_new, (t_method)recorder_free,
                             sizeof(t_recorder), CLASS_DEFAULT, A_SYMBOL, A_NULL);
  class_addanything(recorder_class, (t_method)recorder_anything);
}
