#include "pd/box.h"

#include <string>

namespace gait::pd {

struct ColdInlet::Proxy {
  t_pd pd;
  Box* box;
  void* self;
  Take take;
};

namespace {

void take_anything(ColdInlet::Proxy* proxy, t_symbol* selector, int count, t_atom* atoms);

t_class* proxy_class() {
  static t_class* const cls = [] {
    t_class* made = class_new(gensym("gait cold inlet"), nullptr, nullptr, sizeof(ColdInlet::Proxy),
                              CLASS_PD, A_NULL);
    class_addanything(made, reinterpret_cast<t_method>(&take_anything));
    return made;
  }();
  return cls;
}

// What an error is about: its text, whatever numbers are in it.
std::size_t without_numbers(const std::string& text) {
  std::size_t hash = 14695981039346656037U;
  for (const char c : text)
    if ((c < '0' || c > '9') && c != '-' && c != '.')
      hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return hash;
}

void take_anything(ColdInlet::Proxy* proxy, t_symbol* selector, int count, t_atom* atoms) {
  try {
    proxy->take(proxy->self,
                Arguments(proxy->box->name(), selector ? selector->s_name : "list", count, atoms));
  } catch (const std::exception& error) {
    say_error(*proxy->box, error.what());
  }
}

}  // namespace

void say_error(Box& box, const std::string& what) {
  const std::size_t about = without_numbers(what);
  Box::Said* said = &box.said[0];  // the same error's, else the oldest
  for (Box::Said& other : box.said) {
    if (other.what == about) {
      said = &other;
      break;
    }
    if (other.at < said->at) said = &other;
  }
  if (said->what == about && clock_gettimesince(said->at) < 1000) {
    ++said->unsaid;
    return;
  }
  const int times = said->what == about ? said->unsaid + 1 : 1;
  *said = {about, clock_getlogicaltime(), 0};
  if (times > 1)
    pd_error(&box, "%s (%d times since it was said last)", what.c_str(), times);
  else
    pd_error(&box, "%s", what.c_str());
}
void complain(Box& box, const std::string& what) { say_error(box, box.name() + (": " + what)); }

ColdInlet::ColdInlet(Box& box, void* self, Take take) {
  proxy_ = reinterpret_cast<Proxy*>(pd_new(proxy_class()));
  proxy_->box = &box;
  proxy_->self = self;
  proxy_->take = take;
  inlet_new(&box.object, &proxy_->pd, nullptr, nullptr);
}

ColdInlet::~ColdInlet() { pd_free(&proxy_->pd); }

bool may_register(const char* name) { return zgetfn(&pd_objectmaker, gensym(name)) == nullptr; }

void finish_class(t_class* cls, const char* name, t_newmethod make) {
  class_addcreator(make, gensym((std::string("gait/") + name).c_str()), A_GIMME, A_NULL);
  class_sethelpsymbol(cls, gensym((std::string("help_patches/") + name).c_str()));
}

}  // namespace gait::pd
