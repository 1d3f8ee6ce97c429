// matio.h — libmatio, loaded for tests: it brings forty libraries along, which no other process has to load.
#pragma once

#include <dlfcn.h>
#include <matio.h>

#include <stdexcept>
#include <string>

namespace kurbel::test {

template <class Function>
Function* of_matio(const char* name) {
  static void* const library = dlopen("libmatio.so", RTLD_NOW);
  void* const found = library ? dlsym(library, name) : nullptr;
  if (!found) throw std::runtime_error(std::string("libmatio is not installed (libmatio-dev): ") + name);
  return reinterpret_cast<Function*>(found);
}

}  // namespace kurbel::test
