// SPDX-License-Identifier: BSD-3-Clause
#include "user/library.hpp"

#include <dlfcn.h>
#include <elf.h>
#include <link.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "base/diagnostics.hpp"
#include "base/text.hpp"
#include "user/crash.hpp"

namespace engrane::user {

namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::vector<fs::path> folders(const std::string& deck_folder) {
  std::vector<fs::path> all{deck_folder.empty() ? fs::path(".") : fs::path(deck_folder)};
  if (const char* list = std::getenv("ENGRANE_USER_PATH")) {
    std::istringstream words(list);
    for (std::string folder; std::getline(words, folder, ':');)
      if (!folder.empty()) all.emplace_back(folder);
  }
  return all;
}

bool only_neighbours = false;
std::vector<std::string> loaded_files;

/// Whether the file, with symbolic links resolved, is in the folder or below it. False for an empty folder, which stands for an
/// absolute path.
bool lies_below(const fs::path& file, const fs::path& folder) {
  if (folder.empty()) return false;
  std::error_code error;
  const std::string relative = fs::canonical(file, error).lexically_relative(fs::canonical(folder, error)).string();
  return !error && !relative.empty() && !relative.starts_with("..");
}

/// Number of entries of the symbol table. No dynamic entry gives it, but the GNU hash table indexes the last symbol.
std::size_t symbol_count(const std::uint32_t* hash) {
  const std::uint32_t buckets = hash[0], first = hash[1], bloom = hash[2];
  const auto* bucket = reinterpret_cast<const std::uint32_t*>(reinterpret_cast<const ElfW(Addr)*>(hash + 4) + bloom);
  const std::uint32_t* chain = bucket + buckets;
  std::uint32_t last = 0;
  for (std::uint32_t i = 0; i < buckets; ++i) last = std::max(last, bucket[i]);
  if (last < first) return first;
  while ((chain[last - first] & 1U) == 0) ++last;
  return last + 1;
}

}  // namespace

void Library::trust_only_neighbours() { only_neighbours = true; }
std::vector<std::string> Library::loaded() { return loaded_files; }

std::shared_ptr<const Library> Library::open(const std::string& name, const std::string& folder, Fault& fault) {
  std::vector<fs::path> places;
  if (name.empty() || name.find('\0') != std::string::npos) {
    fault = {"the library has no name", "give the file of a shared library and the routine: USER \"libmine.so\" \"spring\""};
    return nullptr;
  }
  const fs::path wanted(name);
  const std::vector<fs::path> bases = wanted.is_absolute() ? std::vector<fs::path>{""} : folders(folder);
  fs::path found_in;  // base folder in which the first of `places` was found
  for (const fs::path& base : bases)
    for (const char* prefix : {"", "lib"})
      for (const char* suffix : {"", ".so"}) {
        const fs::path place = base / wanted.parent_path() / (prefix + wanted.filename().string() + suffix);
        std::error_code ignored;
        if (!fs::is_regular_file(place, ignored)) continue;
        if (places.empty()) found_in = base;
        places.push_back(place);
      }
  if (places.empty()) {
    fault.message = "there is no library \"" + name + "\"";
    if (!wanted.is_absolute()) {
      fault.message += folder.empty() ? " beside the deck" : " in " + folder;
      fault.message += std::getenv("ENGRANE_USER_PATH") ? " or in the folders of ENGRANE_USER_PATH"
                                                        : ", and ENGRANE_USER_PATH names no other folder";
    }
    fault.hint =
        "compile it (gcc or gfortran -shared -fPIC mine.c -o libmine.so), put it beside the deck or name its folder in "
        "ENGRANE_USER_PATH";
    return nullptr;
  }
  // without a folder, dlopen() would search the linker's path
  const fs::path file = fs::absolute(places.front());
  if (only_neighbours && !lies_below(file, found_in)) {
    fault = {"the library " + file.string() + " lies neither beside the deck nor in a folder of ENGRANE_USER_PATH",
             "checking the deck would run what is in it; engrane check --allow-user does"};
    return nullptr;
  }
  void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle) {
    if (std::find(loaded_files.begin(), loaded_files.end(), file.string()) == loaded_files.end())
      loaded_files.push_back(file.string());
    watch_for_crashes();
    return std::shared_ptr<const Library>(new Library(handle, file.filename().string()));
  }
  const char* why = dlerror();
  std::string reason = why ? why : "";
  // it starts with the full path, which is less helpful than the name
  if (reason.rfind(file.string() + ": ", 0) == 0) reason = reason.substr(file.string().size() + 2);
  fault.message = "\"" + name + "\" is no shared library that can be loaded: " + reason;
  fault.hint = "compile it with -shared -fPIC, and link it with whatever it calls";
  return nullptr;
}

engrane_routine* Library::routine(const std::string& name, Fault& fault) const {
  for (const std::string& spelling : {name, name + "_", lower(name), lower(name) + "_"})
    if (void* address = dlsym(handle_, spelling.c_str())) {
      // dlsym() also finds what the library is linked with, such as sin() of the C library
      Dl_info info{};
      const bool own = dladdr(address, &info) != 0 && info.dli_fname && fs::path(info.dli_fname).filename() == file_;
      if (own) return reinterpret_cast<engrane_routine*>(address);
    }
  const std::vector<std::string> present = functions();
  fault.message = file_ + " has no routine \"" + name + "\"";
  const std::string near = nearest(name, present);
  if (!near.empty()) fault.hint = "did you mean \"" + near + "\"? ";
  std::vector<std::string> shown(present.begin(),
                                 present.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(present.size(), 12)));
  fault.hint += near.empty() ? "it has " : "It has ";
  if (shown.size() < present.size())
    fault.hint += join(shown, ", ") + ", …";
  else
    fault.hint += present.empty() ? "none at all" : join(shown);
  return nullptr;
}

std::vector<std::string> Library::functions() const {
  std::vector<std::string> names;
  link_map* map = nullptr;
  if (dlinfo(handle_, RTLD_DI_LINKMAP, &map) != 0 || !map) return names;
  const char* strings = nullptr;
  const ElfW(Sym)* symbols = nullptr;
  std::size_t count = 0;
  for (const ElfW(Dyn)* entry = map->l_ld; entry->d_tag != DT_NULL; ++entry) {
    const auto address = entry->d_un.d_ptr;  // glibc has made it absolute
    if (entry->d_tag == DT_STRTAB) strings = reinterpret_cast<const char*>(address);
    if (entry->d_tag == DT_SYMTAB) symbols = reinterpret_cast<const ElfW(Sym)*>(address);
    if (entry->d_tag == DT_GNU_HASH) count = symbol_count(reinterpret_cast<const std::uint32_t*>(address));
    if (entry->d_tag == DT_HASH && count == 0) count = reinterpret_cast<const std::uint32_t*>(address)[1];
  }
  if (!strings || !symbols) return names;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& symbol = symbols[i];
    const bool is_function = (symbol.st_info & 0xf) == STT_FUNC && symbol.st_shndx != SHN_UNDEF;
    std::string name = strings + symbol.st_name;
    if (!is_function || name == "_init" || name == "_fini" || name.starts_with("__")) continue;
    if (name.size() > 1 && name.back() == '_') name.pop_back();
    names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace engrane::user
