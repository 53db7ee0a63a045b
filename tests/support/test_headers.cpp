// Nothing but headers: what the tests share of them is compiled in advance with this target.
