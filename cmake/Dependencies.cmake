# Every third-party library, found in one place; all are packages of Debian 12 (packages.txt).
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(yaml-cpp REQUIRED)
find_package(fmt REQUIRED)
find_package(Ceres 2.1 REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(SQLite3 REQUIRED)
# lcm.pc of Debian asks for glib's development files, which neither our code nor lcm's headers need.
find_path(LCM_INCLUDE lcm/lcm.h REQUIRED)
find_library(LCM_LIBRARY lcm REQUIRED)
add_library(lcm SHARED IMPORTED)
set_target_properties(lcm PROPERTIES IMPORTED_LOCATION ${LCM_LIBRARY}
                                     INTERFACE_INCLUDE_DIRECTORIES ${LCM_INCLUDE})
find_program(LCM_GEN lcm-gen REQUIRED)
find_program(PYTHON3 python3 REQUIRED)
# yaml-cpp 0.7 of Debian defines the target without its namespace.
if(NOT TARGET yaml-cpp::yaml-cpp)
  add_library(yaml-cpp::yaml-cpp ALIAS yaml-cpp)
endif()
# matio of Debian has a .pc file only, which asks for HDF5's development files; we need none.
find_path(MATIO_INCLUDE matio.h REQUIRED)
find_library(MATIO_LIBRARY matio REQUIRED)
add_library(matio SHARED IMPORTED)
set_target_properties(matio PROPERTIES IMPORTED_LOCATION ${MATIO_LIBRARY}
                                       INTERFACE_INCLUDE_DIRECTORIES ${MATIO_INCLUDE})
# libzstd of Debian has a .pc file only.
find_path(ZSTD_INCLUDE zstd.h REQUIRED)
find_library(ZSTD_LIBRARY zstd REQUIRED)
add_library(zstd SHARED IMPORTED)
set_target_properties(zstd PROPERTIES IMPORTED_LOCATION ${ZSTD_LIBRARY}
                                      INTERFACE_INCLUDE_DIRECTORIES ${ZSTD_INCLUDE})
# libgpiod of Debian 12 (1.6) has a .pc file only.
find_path(GPIOD_INCLUDE gpiod.h REQUIRED)
find_library(GPIOD_LIBRARY gpiod REQUIRED)
add_library(gpiod SHARED IMPORTED)
set_target_properties(gpiod PROPERTIES IMPORTED_LOCATION ${GPIOD_LIBRARY}
                                       INTERFACE_INCLUDE_DIRECTORIES ${GPIOD_INCLUDE})
# libsodium of Debian has a .pc file only.
find_path(SODIUM_INCLUDE sodium.h REQUIRED)
find_library(SODIUM_LIBRARY sodium REQUIRED)
add_library(sodium SHARED IMPORTED)
set_target_properties(sodium PROPERTIES IMPORTED_LOCATION ${SODIUM_LIBRARY}
                                        INTERFACE_INCLUDE_DIRECTORIES ${SODIUM_INCLUDE})
# cpp-httplib of Debian is compiled with these switches, and its classes differ without them.
find_path(HTTPLIB_INCLUDE httplib.h REQUIRED)
find_library(HTTPLIB_LIBRARY cpp-httplib REQUIRED)
add_library(httplib SHARED IMPORTED)
set_target_properties(httplib PROPERTIES
  IMPORTED_LOCATION ${HTTPLIB_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${HTTPLIB_INCLUDE}
  INTERFACE_COMPILE_DEFINITIONS
    "CPPHTTPLIB_OPENSSL_SUPPORT;CPPHTTPLIB_ZLIB_SUPPORT;CPPHTTPLIB_BROTLI_SUPPORT")
