/* Objects for tests only.
   [recorder FILE]: writes every message it gets as a line, numbers in full precision, so that tests
   can compare what a patch sends with what the core computes.
   [ticks~]: measures the processor time that Pd's thread spends from block to block; 0 begins anew,
   bang posts `ticks: MEAN MAX COUNT`, microseconds.
   [watch]: 1 begins to count what Pd's thread allocates, 0 ends it and posts `watch: N`. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <m_pd.h>
#include <stdio.h>
#include <time.h>

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

static t_class* ticks_class;

typedef struct {
  t_object object;
  double last, sum, most;
  int count;
} t_ticks;

static t_int* ticks_perform(t_int* w) {
  t_ticks* x = (t_ticks*)w[1];
  struct timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  const double microseconds = 1e6 * (double)now.tv_sec + 1e-3 * (double)now.tv_nsec;
  if (x->last > 0) {
    const double took = microseconds - x->last;
    x->sum += took;
    if (took > x->most) x->most = took;
    ++x->count;
  }
  x->last = microseconds;
  return w + 2;
}

static void ticks_dsp(t_ticks* x, t_signal** signals) {
  (void)signals;
  dsp_add(ticks_perform, 1, x);
}

static void ticks_float(t_ticks* x, t_float unused) {
  (void)unused;
  x->sum = x->most = x->last = 0;
  x->count = 0;
}

static void ticks_bang(t_ticks* x) {
  post("ticks: %g %g %d", x->count > 0 ? x->sum / x->count : 0, x->most, x->count);
}

static void* ticks_new(void) { return pd_new(ticks_class); }

__attribute__((visibility("default"))) void recorder_setup(void);
void recorder_setup(void) {
  recorder_class = class_new(gensym("recorder"), (t_newmethod)recorder_new, (t_method)recorder_free,
                             sizeof(t_recorder), CLASS_DEFAULT, A_SYMBOL, A_NULL);
  class_addanything(recorder_class, (t_method)recorder_anything);
  watch_class = class_new(gensym("watch"), (t_newmethod)watch_new, 0, sizeof(t_object),
                          CLASS_DEFAULT, A_NULL);
  class_addfloat(watch_class, (t_method)watch_float);
  ticks_class = class_new(gensym("ticks~"), (t_newmethod)ticks_new, 0, sizeof(t_ticks),
                          CLASS_DEFAULT, A_NULL);
  class_addmethod(ticks_class, (t_method)ticks_dsp, gensym("dsp"), A_CANT, A_NULL);
  class_addfloat(ticks_class, (t_method)ticks_float);
  class_addbang(ticks_class, (t_method)ticks_bang);
}
