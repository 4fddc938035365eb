// The life of an object in Pd: a C++ class behind a box, its messages, its inlets.
//
// A class T is made by T(Box&, const Arguments&) when its box is, and deleted with it. Messages are
// member functions that take the message's arguments; what they throw becomes one line on Pd's
// console, and the box stays as it was. Nothing that comes at frame rate throws.
#pragma once

#include <m_pd.h>

#include <exception>
#include <string>

#include "pd/arguments.h"

namespace gait::pd {

// What Pd keeps of an object. Pd makes it of zeros.
struct Box {
  t_object object;
  void* self;
  // Errors said lately, so that what frames cause is said once a second: what they are about, when
  // (Pd's time), and how often since.
  static constexpr int most_said = 4;
  struct Said {
    std::size_t what;
    double at;
    int unsaid;
  } said[most_said];

  t_pd* pd() { return &object.ob_pd; }
  const char* name() const { return class_getname(object.ob_pd); }
};

// Prints an error on the console, for this box ("Find last error" leads to it). The same error with
// other numbers is printed once a second at most, with its count.
void say_error(Box& box, const std::string& what);
// The same with the box's name first: `gait.map: ...`.
void complain(Box& box, const std::string& what);

// An inlet that takes any message without being the first. Its owner must keep it.
class ColdInlet {
 public:
  using Take = void (*)(void* self, const Arguments& arguments);
  ColdInlet(Box& box, void* self, Take take);
  ~ColdInlet();
  ColdInlet(const ColdInlet&) = delete;
  ColdInlet& operator=(const ColdInlet&) = delete;

  struct Proxy;

 private:
  Proxy* proxy_;
};

// `T::cold` as a ColdInlet's Take.
template <class T>
void take_cold(void* self, const Arguments& arguments) {
  static_cast<T*>(self)->cold(arguments);
}

// True when no class of that name is registered yet. The library may be loaded twice, as copies of
// one file; Pd complains of a class that is registered again, and overwrites it.
bool may_register(const char* name);
// Also reachable as gait/NAME, and with its help patch in help_patches/.
void finish_class(t_class* cls, const char* name, t_newmethod make);

// Registers an object of the library; does nothing when one of that name is registered already.
template <class T>
class Class {
 public:
  // `flags`: CLASS_NOINLET, CLASS_MULTICHANNEL (0x10), ...
  explicit Class(const char* name, int flags = CLASS_DEFAULT) : fresh_(may_register(name)) {
    if (!fresh_) return;
    cls_ = class_new(gensym(name), reinterpret_cast<t_newmethod>(&make),
                     reinterpret_cast<t_method>(&destroy), sizeof(Box), flags, A_GIMME, A_NULL);
    finish_class(cls_, name, reinterpret_cast<t_newmethod>(&make));
  }

  template <auto Method>
  Class& message(const char* selector) {
    if (fresh_)
      class_addmethod(cls_, reinterpret_cast<t_method>(&call<Method>), gensym(selector), A_GIMME,
                      A_NULL);
    return *this;
  }
  // Several messages, each with its selector in the same order.
  template <auto... Methods>
  Class& messages(const char* const (&selectors)[sizeof...(Methods)]) {
    int i = 0;
    (message<Methods>(selectors[i++]), ...);
    return *this;
  }
  // The messages that drive a walk: bang, 1 and 0, advance, start and stop.
  Class& walker() {
    return bang<&T::bang>()
        .template list<&T::number>()
        .template messages<&T::advance, &T::start, &T::stop>({"advance", "start", "stop"});
  }
  // A bang, a list without a selector (a float too), a symbol: they arrive as their own selectors.
  template <auto Method>
  Class& bang() {
    if (fresh_) class_addbang(cls_, reinterpret_cast<t_method>(&call_bang<Method>));
    return *this;
  }
  template <auto Method>
  Class& list() {
    if (fresh_) class_addlist(cls_, reinterpret_cast<t_method>(&call<Method>));
    return *this;
  }
  // All messages that no other handler takes.
  template <auto Method>
  Class& anything() {
    if (fresh_) class_addanything(cls_, reinterpret_cast<t_method>(&call<Method>));
    return *this;
  }
  // Answers all other messages with an error in the library's words instead of Pd's.
  Class& refuse_others() {
    if (fresh_) class_addanything(cls_, reinterpret_cast<t_method>(&refuse));
    return *this;
  }
  // void T::dsp(t_signal**), when the DSP graph is made.
  Class& dsp() {
    if (fresh_)
      class_addmethod(cls_, reinterpret_cast<t_method>(&call_dsp), gensym("dsp"), A_CANT, A_NULL);
    return *this;
  }
  // The messages that every object has: reset, dump, perf and print.
  Class& common() {
    return messages<&T::reset, &T::dump, &T::report_perf, &T::print>(
        {"reset", "dump", "perf", "print"});
  }

 private:
  static void* make(t_symbol* name, int count, t_atom* atoms) {
    auto* box = reinterpret_cast<Box*>(pd_new(cls_));
    box->self = nullptr;
    try {
      box->self = new T(*box, Arguments(box->name(), "", count, atoms));
    } catch (const std::exception& error) {
      say_error(*box, error.what());
      pd_free(box->pd());
      return nullptr;
    }
    (void)name;
    return box;
  }
  static void destroy(Box* box) { delete static_cast<T*>(box->self); }

  // A number alone comes as a list without a selector.
  static const char* name_of(t_symbol* selector) { return selector ? selector->s_name : "list"; }

  template <auto Method>
  static void call(Box* box, t_symbol* selector, int count, t_atom* atoms) {
    try {
      (static_cast<T*>(box->self)->*Method)(
          Arguments(box->name(), name_of(selector), count, atoms));
    } catch (const std::exception& error) {
      say_error(*box, error.what());
    }
  }
  template <auto Method>
  static void call_bang(Box* box) {
    call<Method>(box, &s_bang, 0, nullptr);
  }
  static void refuse(Box* box, t_symbol* selector, int, t_atom*) {
    complain(*box, std::string(name_of(selector)) + ": no such message");
  }
  static void call_dsp(Box* box, t_signal** signals) { static_cast<T*>(box->self)->dsp(signals); }

  bool fresh_;
  static inline t_class* cls_ = nullptr;
};

}  // namespace gait::pd
