#error "The component 'logging' is not in this version yet"
