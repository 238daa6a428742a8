"""The pin-pallet escapement, as in Roskopf's watch: two pins on a balance let a tooth pass at each swing."""
